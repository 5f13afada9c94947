// The variants of a sweep: all combinations of listed values of keys, and samples of random ones.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/sweep/random_value.hpp"

namespace ashlar {

/// A key of a scene and its values, as in --set (scene_overrides.hpp).
struct VariedKey {
  std::string key;
  std::vector<std::string> values;  ///< empty: random
  std::optional<Distribution> drawn = std::nullopt;
};

/// Number and seed of random samples.
struct Samples {
  std::size_t count = 0;  ///< 0: no random key
  std::uint64_t seed = 1;
};

/// "key=a,b,c", or "key=normal(32, 2)" (random_value.hpp). Commas within brackets, braces and quotes belong to a value.
/// @throws std::invalid_argument with the fault and the requirement
[[nodiscard]] VariedKey parse_varied_key(const std::string& text);

/// One run of a sweep.
struct Variant {
  std::vector<std::string> values;  ///< one for each key
  std::string folder;               ///< a file name made of keys and values, unique

  bool operator==(const Variant&) const = default;
};

/// All combinations of listed values, the last key fastest, each with the same samples of random ones, in 6 digits:
/// the first samples do not depend on their number.
/// @throws std::invalid_argument if a key, or a value of one, is repeated, or there are more than 100,000; if there
/// are random keys without a number of samples, or a number of samples without random keys
[[nodiscard]] std::vector<Variant> variants_of(const std::vector<VariedKey>& keys,
                                               const Samples& samples = {});

}  // namespace ashlar

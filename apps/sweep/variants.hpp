// The variants of a sweep: every combination of the values that keys of a scene take, and samples of those that are drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/sweep/random_value.hpp"

namespace ashlar {

/// A key of a scene and its values, as in --set (scene_overrides.hpp).
struct VariedKey {
  std::string key;
  std::vector<std::string> values;  ///< empty: drawn
  std::optional<Distribution> drawn = std::nullopt;
};

/// How often values are drawn, and by which seed.
struct Samples {
  std::size_t count = 0;  ///< 0: no key is drawn
  std::uint64_t seed = 1;
};

/// "key=a,b,c", or "key=normal(32, 2)" (random_value.hpp). Commas within brackets, braces and quotes belong to a value.
/// @throws std::invalid_argument with what is wrong and needed
[[nodiscard]] VariedKey parse_varied_key(const std::string& text);

/// One run of a sweep.
struct Variant {
  std::vector<std::string> values;  ///< one for each key
  std::string folder;               ///< a file name made of keys and values, different for different ones

  bool operator==(const Variant&) const = default;
};

/// All combinations of listed values, the last key fastest, and of each the same samples of drawn ones, in 6 digits: the
/// first samples are the same whatever their number is.
/// @throws std::invalid_argument if a key comes twice, or a value of one, or there are more than 100,000; if keys are
/// drawn without a number of samples, or none is drawn with one
[[nodiscard]] std::vector<Variant> variants_of(const std::vector<VariedKey>& keys,
                                               const Samples& samples = {});

}  // namespace ashlar

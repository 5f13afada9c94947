// The variants of a sweep: every combination of the values that keys of a scene take.
#pragma once

#include <string>
#include <vector>

namespace ashlar {

/// A key of a scene and its values, as in --set (scene_overrides.hpp).
struct VariedKey {
  std::string key;
  std::vector<std::string> values;
};

/// "key=a,b,c". Commas within brackets, braces and quotes belong to a value.
/// @throws std::invalid_argument with what is wrong and needed
[[nodiscard]] VariedKey parse_varied_key(const std::string& text);

/// One run of a sweep.
struct Variant {
  std::vector<std::string> values;  ///< one for each key
  std::string folder;               ///< a file name made of keys and values, different for different ones

  bool operator==(const Variant&) const = default;
};

/// All combinations, the last key fastest.
/// @throws std::invalid_argument if a key comes twice, or a value of one, or there are more than 100,000
[[nodiscard]] std::vector<Variant> variants_of(const std::vector<VariedKey>& keys);

}  // namespace ashlar

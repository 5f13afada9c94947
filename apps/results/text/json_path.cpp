#include "apps/results/text/json_path.hpp"

#include <algorithm>
#include <charconv>
#include <string>

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

/// The value below an entry that goes by `key`; null if the path does not begin with it.
const Json* below(const Json& entry, std::string_view key, std::string_view path) {
  if (key.empty() || !path.starts_with(key) || (path.size() > key.size() && path[key.size()] != '.'))
    return nullptr;
  return value_at(entry, path.substr(std::min(key.size() + 1, path.size())));
}

/// The value below an entry of a list that goes by its number; null if the path does not begin with one.
const Json* entry_at(const Json& list, std::string_view path) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), index);
  const auto length = static_cast<std::size_t>(end - path.data());
  if (error != std::errc{} || index >= list.size()) return nullptr;
  return below(list[index], path.substr(0, length), path);
}

}  // namespace

const Json* value_at(const Json& place, std::string_view path) {
  if (path.empty()) return &place;
  if (place.is_object())
    for (const auto& [key, value] : place.items())
      if (const Json* found = below(value, key, path)) return found;
  if (place.is_array())
    for (const Json& entry : place)
      if (entry.is_object())
        for (const auto& [key, value] : entry.items())
          if (value.is_string())
            if (const Json* found = below(entry, value.get_ref<const std::string&>(), path)) return found;
  return place.is_array() ? entry_at(place, path) : nullptr;
}

}  // namespace ashlar

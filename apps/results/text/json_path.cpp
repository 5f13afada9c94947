#include "apps/results/text/json_path.hpp"

#include <algorithm>
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
  return nullptr;
}

}  // namespace ashlar

#include "apps/scene/available_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/scene/name_pattern.hpp"
#include "apps/scene/scene_json.hpp"

namespace ashlar {
namespace {

struct PartialKey {
  const char* path;       ///< glob over paths of keys
  const char* available;  ///< JSON array of the values that work; empty: the key cannot be used yet
};

constexpr std::array<PartialKey, 1> partial_keys = {{
    {"analysis.solver", R"(["auto", "cholmod"])"},
}};

nlohmann::json::json_pointer pointer_to(std::string path) {
  std::replace(path.begin(), path.end(), '.', '/');
  return nlohmann::json::json_pointer("/" + path);
}

std::string list(const nlohmann::json& values) {
  std::string text;
  for (const auto& value : values) text += (text.empty() ? "" : ", ") + value.dump();
  return text;
}

}  // namespace

void check_availability(const Scene& scene, Diagnostics& diagnostics) {
  const nlohmann::json json = to_json(scene);
  for (const auto& [path, places] : scene.places.all())
    for (const PartialKey& partial : partial_keys) {
      // A key that was refused by the reader is not in the scene.
      if (!pattern_matches(partial.path, path) || !json.contains(pointer_to(path))) continue;
      const nlohmann::json& value = json.at(pointer_to(path));
      const nlohmann::json available = nlohmann::json::parse(partial.available);
      if (std::find(available.begin(), available.end(), value) != available.end()) continue;
      const std::string key = path.substr(path.rfind('.') + 1);
      if (available.empty())
        diagnostics.error(places.key, fmt::format("not available in this version ({}), leave it out", key));
      else
        diagnostics.error(places.value, fmt::format("not available in this version ({} = {}), available: {}",
                                                    key, value.dump(), list(available)));
    }
}

}  // namespace ashlar

// [[bolt]] and [[prop]] as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "apps/scene/model/scene_bolt.hpp"

namespace ashlar {

/// Adds the lists `bolt` and `prop`, unless they are empty.
void add_supports(nlohmann::ordered_json& json, const std::vector<SceneBolt>& bolts,
                  const std::vector<SceneProp>& props);

}  // namespace ashlar

// [[water]], [initial_stress], [[boundary]] and fields as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/scene/model/scene_boundary.hpp"
#include "apps/scene/model/scene_initial_stress.hpp"
#include "apps/scene/model/scene_water.hpp"

namespace ashlar {

/// Formulas as text, with the values of parameters in place of their names.
[[nodiscard]] nlohmann::ordered_json to_json(const SceneField& field);
[[nodiscard]] nlohmann::ordered_json to_json(const SceneInitialStress& initial);
[[nodiscard]] nlohmann::ordered_json to_json(const SceneWater& water);
[[nodiscard]] nlohmann::ordered_json to_json(const SceneBoundary& boundary);

}  // namespace ashlar

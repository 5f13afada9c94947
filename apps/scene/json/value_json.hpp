// Values of a scene as JSON that several tables have: vectors, files of histories, fields.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/scene/model/scene_field.hpp"
#include "apps/scene/model/scene_record.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

[[nodiscard]] nlohmann::ordered_json to_json(const Vector3& vector);
[[nodiscard]] nlohmann::ordered_json to_json(const SceneRecord& record);
/// Formulas as text, with the values of parameters in place of their names.
[[nodiscard]] nlohmann::ordered_json to_json(const SceneField& field);

}  // namespace ashlar

// [analysis] as JSON, and values that other tables have too.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "apps/scene/model/scene_analysis.hpp"

namespace ashlar {

[[nodiscard]] nlohmann::ordered_json to_json(const Vector3& vector);
[[nodiscard]] nlohmann::ordered_json to_json(const SceneRecord& record);
[[nodiscard]] nlohmann::ordered_json to_json(const SceneAnalysis& analysis);

/// "auto" if empty.
template <typename Number>
[[nodiscard]] nlohmann::ordered_json or_auto(const std::optional<Number>& number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json("auto");
}

}  // namespace ashlar

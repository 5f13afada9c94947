// The verdict of motion and the peaks of measures in the summary.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/results/folder/motion_verdict.hpp"
#include "apps/results/folder/result_folder.hpp"

namespace ashlar {

/// state ("at rest", "moving"), moving, fastest, speed, displaced, fallen (block, time, drop, distance)
[[nodiscard]] nlohmann::ordered_json verdict_json(const MotionVerdict& verdict, const Simulation& simulation);

/// By column: least and largest, each value and time; null: none.
[[nodiscard]] nlohmann::ordered_json peaks_json(const std::vector<MeasurePeak>& peaks);

}  // namespace ashlar

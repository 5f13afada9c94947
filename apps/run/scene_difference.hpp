// Differences between two scenes by keys, to explain why one cannot continue from the other's checkpoint.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ashlar {

/// Paths of keys as in --set ("analysis.time_step", "block.B.order"), each with both values: "KEY (was A, is B)".
/// Keys without influence on results (title, analysis.end_time, analysis.memory_limit) are ignored.
/// @param was,is scenes from to_json
[[nodiscard]] std::vector<std::string> scene_differences(const nlohmann::ordered_json& was,
                                                         const nlohmann::ordered_json& is);

}  // namespace ashlar

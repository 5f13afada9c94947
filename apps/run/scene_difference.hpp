// In which keys two scenes differ, to tell a user why one cannot go on with the other's checkpoint.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ashlar {

/// Paths of keys as --set takes them ("analysis.time_step", "block.B.order"), each with both values: "KEY
/// (was A, is B)". Keys that no result depends on (title, analysis.end_time, analysis.memory_limit) are
/// passed over.
/// @param was,is scenes as to_json gives them
[[nodiscard]] std::vector<std::string> scene_differences(const nlohmann::ordered_json& was,
                                                         const nlohmann::ordered_json& is);

}  // namespace ashlar

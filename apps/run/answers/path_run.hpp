// The load path of a factor of safety or a capacity (solver/paths/path_search.hpp), from a scene to its summary.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/run/answers/answer.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Follows the path of a search for a factor. @param simulation as placed, without factors
/// @param associated limit above which nothing stands. @param may_continue called before each trial; false ends the search
[[nodiscard]] PathFindings find_path(const Scene& scene, const Simulation& simulation,
                                     const LimitBracket& associated,
                                     const std::function<bool()>& may_continue);

/// "; joints yield from 1.235 on (rock and ground), blocks yield by 1.2 mm up to 1.24": empty if nothing yields before.
[[nodiscard]] std::string onset_in_words(const PathFindings& path, const Simulation& simulation);

/// Adds lower, upper, onset, onset_joints, onset_displacement (m), displacement (m, at lower), allowed_displacement (m),
/// confirmed and path_trials.
void add_path(nlohmann::ordered_json& json, const PathFindings& path, const Simulation& simulation);

}  // namespace ashlar

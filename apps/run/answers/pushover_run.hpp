// analysis.type "pushover": multiplier and displacement along the mechanism, the kinematic check, in text, in the summary
// and as states.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/answers/answer.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Reports pushovers that cannot be followed: an unknown control, partly supported blocks, no gravity, loads to multiply that
/// move no block. @param model of limit_model
void refuse_pushover(const Scene& scene, const std::optional<RigidModel>& model, Diagnostics& diagnostics);

/// A pushover in each direction. @param may_continue called before each step; false ends the search
[[nodiscard]] PushoverFindings find_pushover(const Scene& scene, const Simulation& simulation, int threads,
                                             const std::function<bool()>& may_continue);

/// "multiplier 0.25, zero after 0.125 m (1 block moves); a0* 1.82 m/s^2, ..."
[[nodiscard]] std::string describe(const PushoverFindings& findings, const Simulation& simulation);

/// True if the curve is known up to its end.
[[nodiscard]] bool is_known(const PushoverFindings& findings);

/// direction, status, multiplier, displacement (m, of the zero; null), curve (rows of m and the multiplier), mechanisms
/// (displacement, moving), directions (direction, multiplier, displacement, status) of several.
[[nodiscard]] nlohmann::ordered_json pushover_summary(const PushoverFindings& findings,
                                                      const Simulation& simulation);

/// The keys of `kinematic` in summary.json.
[[nodiscard]] nlohmann::ordered_json kinematic_summary(const KinematicCheck& check);

/// Places along the weakest direction.
[[nodiscard]] std::vector<ShownState> pushover_states(const PushoverFindings& findings);

}  // namespace ashlar

// analysis.type "factor-of-safety" and "capacity" by limit analysis (analysis.method = "limit"): result in text and
// in the summary.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/answers/answer.hpp"
#include "apps/run/answers/limit_choice.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// @param model of limit_model. @param simulation as placed, without factors. @param may_continue called before each trial;
/// false ends the search
[[nodiscard]] LimitFindings find_limits(const Scene& scene, RigidModel model, const Simulation& simulation,
                                        int threads, const std::function<bool()>& may_continue);

/// "factor of safety between 0.593 and 0.597 (rock.8 slides on one plane), up to 0.72 if joints wedge (...)"
[[nodiscard]] std::string describe(const LimitFindings& findings, const SceneAnalysis& analysis,
                                   const Simulation& simulation);

/// method, lower, upper (null if there is none), proven (blocks move at upper), released (the factor for design),
/// associated, gap, mode, moving, accelerations (m/s^2), angular_accelerations (rad/s^2), joints, bolts (bars_json, of
/// scenes with bolts: at lower, or if there is none in the motion), kept_by_others,
/// associated_motion, trials.
[[nodiscard]] nlohmann::ordered_json limit_summary(const LimitFindings& findings,
                                                   const Simulation& simulation);

/// An array: name, axial_force (N, the largest by its amount, tension positive) and shear_force (N) of each bolt with
/// forces.
[[nodiscard]] nlohmann::ordered_json bars_json(const std::vector<BarForce>& forces,
                                               const Simulation& simulation);

/// The motion at the upper end of the factor.
[[nodiscard]] const LimitMotion& signed_motion(const LimitFindings& findings);

/// "block rock.8 slides on one plane", "12 blocks move, block rock.8 fastest: it topples"
[[nodiscard]] std::string words_of(const LimitMotion& motion, const Simulation& simulation);

/// Blocks at the onset of motion: each moved by its acceleration times one time, the largest a share of its size.
/// @return as ShownState::positions
[[nodiscard]] std::vector<Eigen::MatrixX3d> drawn_motion(const LimitMotion& motion,
                                                         const Simulation& simulation);

/// The states of the answer: at rest at the lower end of the factor, and the onset of motion at its upper end, with
/// displacements that can be seen and the forces at rest.
[[nodiscard]] std::vector<ShownState> limit_states(const LimitFindings& findings,
                                                   const SceneAnalysis& analysis,
                                                   const Simulation& simulation);

}  // namespace ashlar

// analysis.type "factor-of-safety" and "capacity" by limit analysis (analysis.method = "limit"): result in text and
// in the summary.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/answer.hpp"
#include "apps/scene/build/scene_loading.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Rigid model of a scene that seeks a factor or thrust. @param simulation as placed, without factors
/// @return empty if the scene seeks neither, or limit analysis does not support its formulation, or
/// is not to be chosen for its bolts: automatic and elastic methods use it only if all bolts are perfectly plastic
[[nodiscard]] std::optional<RigidModel> limit_model(const Scene& scene, const Simulation& simulation);

/// True if a search for a factor uses limit analysis: as the scene specifies, or if that is automatic, if no joint of
/// blocks in contact loses strength permanently and there is no stress of the ground. @param model of limit_model
[[nodiscard]] bool uses_limit_analysis(const Scene& scene, const std::optional<RigidModel>& model);

/// Reports scenes with nothing to find: no block can move, or no load is multiplied.
void refuse_idle_limits(const Scene& scene, const std::optional<RigidModel>& model, Diagnostics& diagnostics);

/// @param model of limit_model. @param simulation as placed, without factors. @param goes_on called before each trial;
/// false ends the search
[[nodiscard]] LimitFindings find_limits(const Scene& scene, RigidModel model, const Simulation& simulation,
                                        int threads, const std::function<bool()>& goes_on);

/// "factor of safety between 0.593 and 0.597 (rock.8 slides on one plane), up to 0.72 if joints wedge (...)"
[[nodiscard]] std::string describe(const LimitFindings& findings, const SceneAnalysis& analysis,
                                   const Simulation& simulation);

/// method, lower, upper (of the released factor; null if there is none), released (the factor for design),
/// associated, gap, mode, moving, accelerations (m/s^2), angular_accelerations (rad/s^2), joints, bolts (bars_json, of
/// scenes with bolts), kept_by_others,
/// associated_motion, trials.
[[nodiscard]] nlohmann::ordered_json limit_summary(const LimitFindings& findings,
                                                   const Simulation& simulation);

/// The simulation's bolts with the forces of a limit state. Collective.
void set_bolts(const std::vector<BarForce>& forces, Simulation& simulation);

/// An array: name, axial_force (N, the largest by its amount, tension positive) and shear_force (N) of each bolt with
/// forces.
[[nodiscard]] nlohmann::ordered_json bars_json(const std::vector<BarForce>& forces,
                                               const Simulation& simulation);

/// The motion at the upper end of the factor.
[[nodiscard]] const LimitMotion& signed_motion(const LimitFindings& findings);

/// "block rock.8 slides on one plane", "12 blocks move, block rock.8 fastest: it topples"
[[nodiscard]] std::string words_of(const LimitMotion& motion, const Simulation& simulation);

/// Displacements for a drawing of the onset of motion: each acceleration times one time, the largest a share of the
/// block's size.
[[nodiscard]] std::vector<RigidDisplacement> drawn_motion(const LimitMotion& motion,
                                                          const Simulation& simulation);

}  // namespace ashlar

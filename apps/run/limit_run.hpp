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

/// Method of a search for a factor, and why if the scene leaves it open.
struct MethodChoice {
  bool limit = false;  ///< limit analysis; else static analyses
  std::string
      reason;  ///< "b has no shear_strength, which limit analysis needs"; empty: the scene names the method
};
/// As the scene specifies, or if that is automatic, limit analysis unless it lacks a property of the scene.
/// @param model of limit_model. @return static analyses if no factor is sought
[[nodiscard]] MethodChoice choose_method(const Scene& scene, const Simulation& simulation,
                                         const std::optional<RigidModel>& model);

/// Reports scenes with nothing to find: no block can move, or no load is multiplied.
void refuse_idle_limits(const Scene& scene, const Simulation& simulation,
                        const std::optional<RigidModel>& model, Diagnostics& diagnostics);

/// @param model of limit_model. @param simulation as placed, without factors. @param goes_on called before each trial;
/// false ends the search
[[nodiscard]] LimitFindings find_limits(const Scene& scene, RigidModel model, const Simulation& simulation,
                                        int threads, const std::function<bool()>& goes_on);

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

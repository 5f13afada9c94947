// Choice of limit analysis for a search: its rigid model, the reason, and scenes that it refuses.
#pragma once

#include <optional>
#include <string>

#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/limit/rigid_model.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Rigid model of a scene that seeks a factor or thrust. @param simulation as placed, without factors
/// @return empty if the scene seeks neither, or limit analysis does not support its formulation, or
/// is not to be chosen for its bolts: automatic and elastic methods use it only if all bolts are perfectly plastic
[[nodiscard]] std::optional<RigidModel> limit_model(const Scene& scene, const Simulation& simulation);

/// The first bolt that lacks a property for limit analysis, and the property: "b has no shear_strength". Empty: none
[[nodiscard]] std::string lacking_bolt(const Simulation& simulation);

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
void refuse_idle_limits(const Scene& scene, const std::optional<RigidModel>& model, Diagnostics& diagnostics);

}  // namespace ashlar

// summary.json: work done and skipped by a run, its times and its energy balance.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/results/folder/run_outcome.hpp"
#include "apps/results/folder/scene_identity.hpp"
#include "apps/scene/assemble/build_simulation.hpp"

namespace ashlar {

/// @param scene of the whole run. @param identity of that scene
[[nodiscard]] nlohmann::ordered_json run_summary(const Scene& scene, const SceneIdentity& identity,
                                                 const BuiltSimulation& built, const RunOutcome& outcome);

/// From places of the model to the user's coordinates, in all parts of a summary but its scene; the key `origin` has the
/// origin. @param origin m, Scene::origin; zero: nothing changes
void add_origin(nlohmann::ordered_json& summary, const Vector3& origin);

/// Joints that have failed since the start of the run.
struct BrokenJoints {
  int pairs = 0;         ///< pairs of blocks with failed area
  double area = 0.0;     ///< m^2
  double of_area = 0.0;  ///< m^2, of all joints with strength
};
[[nodiscard]] BrokenJoints broken_joints(const Simulation& simulation);

}  // namespace ashlar

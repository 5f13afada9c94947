// summary.json: what a run did, what it skipped, how long it took and how well its energies add up.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/results/run_outcome.hpp"
#include "apps/results/scene_identity.hpp"
#include "apps/scene/build_simulation.hpp"

namespace ashlar {

/// @param scene of the whole run. @param identity of the same
[[nodiscard]] nlohmann::ordered_json run_summary(const Scene& scene, const SceneIdentity& identity,
                                                 const BuiltSimulation& built, const RunOutcome& outcome);

/// Joints that have lost their strength since the start of the run.
struct BrokenJoints {
  int pairs = 0;         ///< of blocks, that have lost any
  double area = 0.0;     ///< m^2
  double of_area = 0.0;  ///< m^2, of all joints that had strength to lose
};
[[nodiscard]] BrokenJoints broken_joints(const Simulation& simulation);

}  // namespace ashlar

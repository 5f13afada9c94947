// The data of a simulation beyond its scene. Restored into a simulation built from the same scene, it continues the
// run bit for bit as if it had never stopped.
#pragma once

#include <array>
#include <map>

#include "mechanics/block/incremental_block.hpp"
#include "solver/step/step_caches.hpp"

namespace ashlar {

/// All data that a step depends on or reports, except those that follow from the scene.
struct SimulationSnapshot {
  RunState run;                         ///< counts are those of the whole run
  std::map<int, CarriedShape> carried;  ///< of incremental blocks
  FinderState finder;
  std::vector<KeptFactor> factors;
  std::map<std::array<int, 2>, double> load_factors;  ///< BlockSystem::load_factors
  std::map<int, Eigen::MatrixX3d> reactions;          ///< BlockSystem::reactions
};

/// Work done and skipped by a run so far.
[[nodiscard]] SimulationCounts counts_of(const RunState& state, const StepCaches& caches);

[[nodiscard]] SimulationSnapshot snapshot_of(const BlockSystem& system, const RunState& state,
                                             const StepCaches& caches);
/// The same without pairs and records, which are the larger part of it.
[[nodiscard]] SimulationSnapshot snapshot_without_pairs(const BlockSystem& system, const RunState& state,
                                                        const StepCaches& caches);
/// A copy without pairs and records.
[[nodiscard]] SimulationSnapshot without_pairs(const SimulationSnapshot& snapshot);
/// @throws std::invalid_argument if the snapshot was taken of other blocks: nothing has changed then
void restore(BlockSystem& system, RunState& state, StepCaches& caches, const SimulationSnapshot& snapshot);

}  // namespace ashlar

// A step as a problem: bodies, contact pairs and islands, and their solution. The run changes only when a step is
// accepted (accepted_step.hpp).
#pragma once

#include <map>
#include <vector>

#include "mechanics/block/incremental_block.hpp"
#include "solver/contact/contact_pair.hpp"
#include "solver/contact/depth_audit.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"
#include "solver/step/island/factor_cache.hpp"
#include "solver/step/island/island.hpp"
#include "solver/step/island/time_scheme.hpp"

namespace ashlar {

/// A trial step. Pairs whose rows were updated replace the original ones until the step is tried again.
struct StepProblem {
  std::vector<FoundContacts> found;  ///< contacts that the pairs were made from
  std::vector<ContactPair> pairs;
  TimeScheme scheme;  ///< of the last trial
  std::vector<StepBolt> bolts;
  std::vector<Island> islands;
  int shared = -1;  ///< index of the island that several processes share (step_exchange.hpp); -1: none
  std::vector<BodyStep> bodies;
  std::vector<IslandResult> results;            ///< by island
  std::map<std::size_t, CarriedBlock> carried;  ///< next steps of incremental blocks
  Audit audit;                                  ///< of its end
};

/// Finds islands and bodies of a problem whose pairs are given, and solves it.
/// @param state its log counts the work. @return converged, or the status of the first island that is not
[[nodiscard]] IslandStatus solve(const BlockSystem& system, RunState& state, const TimeScheme& scheme,
                                 FactorCache& factors, StepProblem& problem);

/// Finds islands and bodies of a problem whose pairs are given: the first part of solve().
void pose_step(const BlockSystem& system, const RunState& state, const TimeScheme& scheme,
               StepProblem& problem);

/// Gravity and loads of a block at the time where the integrator evaluates them, (p, 3).
[[nodiscard]] Eigen::MatrixX3d external_force(const BlockSystem& system, const StepClock& clock, int block,
                                              const TimeScheme& scheme);

/// States with the velocities that moving supports will impose; empty if no support moves.
/// @param step s; 0: as if the iteration of a static analysis took one second
[[nodiscard]] std::vector<BlockState> driven_states(const BlockSystem& system, const RunState& state,
                                                    double step);

/// Accelerations in balance with the smooth forces of the present state, (p, 3) of each block.
[[nodiscard]] std::vector<Eigen::MatrixX3d> smooth_accelerations(const BlockSystem& system,
                                                                 const RunState& state);

/// States with the positions at the end of a solved problem and the velocities of its start.
[[nodiscard]] std::vector<BlockState> states_after(const BlockSystem& system, const RunState& state,
                                                   const StepProblem& problem);

}  // namespace ashlar

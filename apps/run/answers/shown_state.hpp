// States that an answer speaks of, written as steps like those of any run: forces in balance at a factor, at the least or
// largest thrust or at the end of a movement, and the onset of the motion beyond.
#pragma once

#include <string>
#include <vector>

#include "solver/limit/rigid_bolts.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

class RunGroup;

/// Forces that balance all loads within the strengths of joints and bolts.
struct BalancedForces {
  std::vector<PairRecord> contacts;  ///< by pair
  std::vector<BarForce> bars;        ///< of bolts and props
};

struct ShownState {
  std::string name;  ///< "at rest under load factor 23.07", "motion beyond it, enlarged"
  /// Reference coefficients by block, (p, 3); empty: blocks as placed
  std::vector<Eigen::MatrixX3d> positions;
  BalancedForces forces;  ///< contacts have the places of the positions
};

/// @param force by point of the model, in its units and frames. @param divided, factor as for contact_records
[[nodiscard]] BalancedForces balanced_forces(const RigidModel& model,
                                             const std::vector<Eigen::Vector3d>& force,
                                             const std::vector<bool>& divided = {}, double factor = 1.0);

/// The forces of placed blocks, with contacts moved to where the blocks of both sides are. Directions stay.
/// @param positions as ShownState
[[nodiscard]] BalancedForces carried(BalancedForces forces, const std::vector<Eigen::MatrixX3d>& positions,
                                     const Simulation& placed);

/// Takes the state as a step of the simulation. Collective. @param end_time of the loads, s. @param group that shares the
/// simulation
void show(const ShownState& state, double end_time, const RunGroup& group, Simulation& simulation);

}  // namespace ashlar

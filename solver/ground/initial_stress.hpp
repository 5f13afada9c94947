// Contacts that begin under the stress of the ground.
#pragma once

#include <map>
#include <optional>

#include "solver/contact/pair_history.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// A block whose contacts, loads and weight do not add up to zero.
struct StressImbalance {
  int block;
  double force;  ///< N, of the sum
  double share;  ///< of the sum of their sizes

  /// Share from which the stress is not that of ground at rest: the block moves until its forces balance.
  static constexpr double notable_share = 0.01;
  /// Also of a share that is not a number.
  [[nodiscard]] bool is_notable() const { return !(share < notable_share); }
};

/// Contacts at the start of a run under stress.
struct StressedContacts {
  std::map<PairKey, ContactMemory> contacts;  ///< those with stress
  /// The block with the largest share. Directions in which supports hold a block, and blocks with ties,
  /// whose forces are not known yet, are not considered
  std::optional<StressImbalance> worst;
};

/// Memory of the contacts of blocks as placed, with which each point has the traction of its blocks' initial stress
/// (BlockDefinition::initial_stress; the mean of both, or that of the one that has any):
///   N = -n . s n A,  shear force on a = -(s n - n (n . s n)) A,   n out of b
/// A spring gets a rest gap N / kn above the surface and a slip, a point with multipliers the forces themselves. A point
/// that the stress pulls begins without force, as does its shear.
/// With several processes collective, for the pairs of own blocks; the worst block is that of the run.
/// @param state at its start, with blocks as placed.
[[nodiscard]] StressedContacts contacts_under_stress(const BlockSystem& system, RunState& state);

}  // namespace ashlar

// Bolts and props of a run: what is constant, and what changes from step to step.
#pragma once

#include <string>
#include <vector>

#include "mechanics/bolt/bolt_chain.hpp"
#include "mechanics/bolt/bolt_memory.hpp"

namespace ashlar {

/// Constant within a stage.
struct Bolt {
  std::string name;
  BoltChain chain;  ///< BoltSpan::block: indices of the run's blocks
  bool installed;   ///< false: not yet, or removed
};

/// A bolt at the end of the last accepted step. Empty vectors: not installed.
struct BoltState {
  BoltMemory
      memory;  ///< evaluations start from it: of the last step, in statics of the start of the load level
  BoltMemory reached;          ///< of the last step or iteration
  double stored = 0.0;         ///< J
  double dissipated = 0.0;     ///< J, >= 0, since `memory`
  std::vector<double> axial;   ///< N, tension positive, by spring of the bar
  std::vector<double> bond;    ///< N, by station, positive where the bar is ahead of the rock
  std::vector<double> dowels;  ///< N, along n_1 and n_2 (bolt_kinematics.hpp) by dowelled crossing

  [[nodiscard]] bool installed() const { return memory.is_installed(); }
};

/// How a bolt is used.
enum class BoltCondition {
  absent,  ///< not installed
  elastic,
  slipped,   ///< its grout has slipped somewhere, or it has yielded in shear
  yielded,   ///< its steel has yielded somewhere
  ruptured,  ///< broken somewhere
};
[[nodiscard]] const char* to_string(BoltCondition condition);

/// Worst condition anywhere along the bolt so far.
[[nodiscard]] BoltCondition condition_of(const Bolt& bolt, const BoltState& state);
/// Force of the bar that is largest by its amount, N, tension positive; 0 if not installed.
[[nodiscard]] double largest_axial_force(const BoltState& state);
/// Largest force across the bar at any joint, N, >= 0.
[[nodiscard]] double largest_shear_force(const BoltState& state);

/// Sets the forces and energies of a state to a response.
void take_forces(const BoltResponse& response, BoltState& state);

}  // namespace ashlar

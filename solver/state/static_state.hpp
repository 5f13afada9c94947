// State of a static analysis (statics/static_analysis.hpp) between iterations.
#pragma once

#include <vector>

#include "mechanics/block/block_model.hpp"
#include "solver/block_pair.hpp"

namespace ashlar {

/// Root mean square over a block of the motion by a change of its coefficients, in its unit.
[[nodiscard]] double mean_motion(const BlockModel& block, const Eigen::MatrixX3d& change);

/// Displacement of blocks since the last halving of their residual. By block.
struct StaticProgress {
  /// Position at the last halving of its residual, (p, 3), and the residual there, N m^-3/2
  std::vector<Eigen::MatrixX3d> positions;
  std::vector<double> forces;
  std::vector<double> displacements;  ///< displacement from there, in block sizes
  /// Residual of the last iteration, (p, 3), N m^-3/2; empty before the first
  std::vector<Eigen::MatrixX3d> residuals;
};

/// Onset of motion of blocks without equilibrium, since the last iteration in equilibrium, or in which a joint
/// failed.
struct StaticOnset {
  std::vector<PairKey> sliding;              ///< joints that slid in the last iteration
  double least_residual = 0.0;               ///< smallest sum of squared residuals of blocks, N^2
  std::vector<Eigen::MatrixX3d> unbalanced;  ///< accelerations in that iteration, (p, 3); empty: none
  bool rigid = false;                        ///< true if these are those of rigid blocks
  std::vector<int>
      is_compliant;  ///< by block: not 0 if it moves by compliance only and rigid blocks would stay
                     ///< (rigid_onset.hpp)
  std::vector<Eigen::MatrixX3d> starts;  ///< by block, positions at that time
};

/// Iterations that lead nowhere, each nearly in balance (statics/static_verdict.hpp).
struct StaticCycle {
  std::vector<Eigen::MatrixX3d>
      positions;  ///< of blocks before the first of them, (p, 3); empty: there are none
  int iterations = 0;
};

/// State of a static analysis between iterations.
struct StaticState {
  double inertia = 0.0;           ///< m of the next iteration, 1/s^2; 0: none yet, nor an equilibrium
  int iterations = 0;             ///< at the present loads
  int still_iterations = 0;       ///< consecutive ones in equilibrium with unchanged contacts
  bool freezes_failure = false;   ///< until the first balance with bonds that do not fail
  int multiplier_iterations = 0;  ///< in equilibrium whose multipliers had not converged
  bool balanced = false;          ///< equilibrium at the present loads
  bool moving = false;
  /// True if the equilibrium is that of rigid blocks along a load path, where the iteration did not decide
  bool rests_rigidly = false;
  std::vector<Eigen::MatrixX3d>
      level_start;  ///< by block, positions at the start of the load level; empty before
  StaticProgress progress;
  StaticOnset onset;
  StaticCycle cycle;
};

}  // namespace ashlar

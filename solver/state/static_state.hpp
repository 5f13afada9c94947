// What a static analysis (statics/static_analysis.hpp) carries from one iteration to the next.
#pragma once

#include <array>
#include <vector>

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Root mean square over a block of the motion that a change of its coefficients is, in its unit.
[[nodiscard]] double mean_motion(const BlockModel& block, const Eigen::MatrixX3d& change);

/// How far blocks have gone without coming nearer to balance. By block.
struct StaticProgress {
  /// Where it was when what it lacks had last been halved, (p, 3), and how much that was, N m^-3/2
  std::vector<Eigen::MatrixX3d> milestones;
  std::vector<double> forces;
  std::vector<double> travels;  ///< from there, in parts of the block's size
  /// What it lacked in the last iteration, (p, 3), N m^-3/2; no blocks before the first
  std::vector<Eigen::MatrixX3d> residuals;
};

/// How blocks set off that no equilibrium holds, since the last iteration in equilibrium, or in which a joint
/// lost its strength.
struct StaticOnset {
  std::vector<std::array<int, 2>> sliding;   ///< joints that slid in the last iteration
  double least_residual = 0.0;               ///< least sum of squares of what blocks lacked, N^2
  std::vector<Eigen::MatrixX3d> unbalanced;  ///< accelerations in that iteration, (p, 3); empty: none
  bool rigid = false;                        ///< whether these are those of rigid blocks
  std::vector<int>
      gives_way;  ///< of each block: not 0 where rigid blocks would have stayed (rigid_onset.hpp)
  std::vector<Eigen::MatrixX3d> starts;  ///< of each block, positions then
};

/// What a static analysis carries from one iteration to the next.
struct StaticState {
  double inertia = 0.0;           ///< m of the next iteration, 1/s^2; 0 before the first
  int iterations = 0;             ///< at the present loads
  int still_iterations = 0;       ///< in equilibrium with unchanged contacts, one after another
  bool freezes_failure = false;   ///< until all is in balance once with bonds that hold
  int multiplier_iterations = 0;  ///< in equilibrium whose multipliers had not converged
  bool balanced = false;          ///< equilibrium at the present loads
  bool moving = false;
  std::vector<Eigen::MatrixX3d> level_start;  ///< of each block, positions when the present loads were put on
  StaticProgress progress;
  StaticOnset onset;
};

}  // namespace ashlar

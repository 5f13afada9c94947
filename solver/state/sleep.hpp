// Sleeping blocks: islands that have come to rest are held, without cost, until they are woken
// (step/detect/sleeping_islands.hpp, notes/sleeping_islands.md).
#pragma once

#include <Eigen/Dense>
#include <limits>
#include <vector>

namespace ashlar {

/// Recent motion of a block. Paths and velocities are those of the mean of two steps, so that motion which alternates
/// from step to step is excluded (notes/sleeping_islands.md).
struct BlockRest {
  /// m, path of its fastest point in the last complete window; infinite before the first
  double last_path = std::numeric_limits<double>::infinity();
  double path = 0.0;        ///< m, in the present window
  Eigen::MatrixX3d motion;  ///< of the last step, (p, 3), m; empty: none
  /// At the start of the present window, (p, 3), m/s; empty before the first window
  Eigen::MatrixX3d velocity;
};

/// Blocks that were put to sleep together and wake together.
struct SleepingIsland {
  std::vector<int> blocks;  ///< increasing
  double held = 0.0;        ///< energy of springs of their contacts and ties, J
};

/// Sleeping islands, and the recent motion of blocks.
struct Sleep {
  std::vector<BlockRest> rests;  ///< by block
  int window_steps = 0;          ///< steps of the present window
  double window_time = 0.0;      ///< s, their sum
  std::vector<SleepingIsland> islands;

  [[nodiscard]] int sleeping_blocks() const {
    int sum = 0;
    for (const SleepingIsland& island : islands) sum += static_cast<int>(island.blocks.size());
    return sum;
  }
};

}  // namespace ashlar

// Which blocks sleep: islands that have come to rest are held as they are, and cost nothing until something
// wakes them (step/sleeping_islands.hpp, notes/sleeping_islands.md).
#pragma once

#include <Eigen/Dense>
#include <limits>
#include <vector>

namespace ashlar {

/// How little a block has moved of late. Paths and velocities are those of the mean of two steps: what alternates
/// from step to step is not in them (notes/sleeping_islands.md).
struct BlockRest {
  /// m, the path of its fastest point in the last whole window; infinite until there was one
  double last_path = std::numeric_limits<double>::infinity();
  double path = 0.0;        ///< m, in the present window
  Eigen::MatrixX3d motion;  ///< of the last step, (p, 3), m; empty: none
  /// At the start of the present window, (p, 3), m/s; empty until one has begun
  Eigen::MatrixX3d velocity;
};

/// Blocks that were put to sleep together and wake together.
struct SleepingIsland {
  std::vector<int> blocks;  ///< increasing
  double held = 0.0;        ///< by springs of their contacts and ties, J
};

/// What sleeps, and what is about to.
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

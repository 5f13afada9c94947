// Differences of two ends of a step, by blocks and by islands.
//
// An island here is a set of moving blocks that are in touch, tied or bolted. Its error of a step is the larger one of
//     sqrt(sum of energies of the difference of its blocks / largest energy of the motion)
//     largest displacement of the difference, root of the mean square over a block / that of the motion
// so that the largest error of all islands is at most that of all blocks together, and at least that over the root
// of their number. With an integrator of order p the error per unit of time falls with h^p: if e is the error of
// one island and f the largest of the others, these would allow a step (e / f)^(1/p) times as long.
#pragma once

#include <vector>

#include "solver/accuracy/motion_accuracy.hpp"

namespace ashlar {

/// Difference of two ends in one block.
struct BlockDifference {
  double energy = 0.0;        ///< J, of motion and of strain
  double displacement = 0.0;  ///< m, root of the mean square over the block
};

/// By block; 0 of blocks that do not move. @param a,b by block
[[nodiscard]] std::vector<BlockDifference> block_differences(const Simulation& simulation,
                                                             const std::vector<BlockState>& a,
                                                             const std::vector<BlockState>& b);

/// Of some blocks together, relative. @param blocks indices of differences
[[nodiscard]] double relative_difference(const std::vector<BlockDifference>& differences,
                                         const std::vector<int>& blocks, const MotionScales& scales);

/// Moving blocks connected by closed contact points, ties and bolts at present; each list ascends, and lists in the order
/// of their first blocks.
[[nodiscard]] std::vector<std::vector<int>> blocks_in_touch(const Simulation& simulation);

/// @param order of the integrator. @return the island with the largest difference; none if no block differs
[[nodiscard]] BoundingIsland bounding_island(const std::vector<std::vector<int>>& islands,
                                             const std::vector<BlockDifference>& differences,
                                             const MotionScales& scales, int order);

}  // namespace ashlar

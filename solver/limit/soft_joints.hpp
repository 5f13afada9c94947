// Compliance of joints about whose edges blocks tip. Limit analysis has rigid edges; springs yield under the pressure of an
// edge, and the block leans. A joint of stiffness k (Pa/m) under a normal force N, of area A and width b = sqrt(A), pressed over
// a width w at its edge by a triangle of stress, has the lever arm b/2 - w/3, and leans by 2 N / (k w^2 b). A load that tips a
// block as high as wide is largest where both losses together are least,
//     w = b (6 c / b)^(1/3),   c = N / (k A),
// and is less by the share w / b than that of a rigid edge.
#pragma once

#include <optional>
#include <vector>

#include "solver/limit/limit_motion.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

struct SoftJoint {
  PairKey blocks;
  double closure;  ///< m, c: under the same force over the whole joint
  double share;    ///< w / b, of the load
};

/// The joint about which blocks tip in a motion with the largest share, of those with a given stiffness and area springs.
/// @param rest contacts of blocks at rest below the limit, N. @return empty: no share is worth telling
[[nodiscard]] std::optional<SoftJoint> softest_joint(const std::vector<PairRecord>& rest,
                                                     const LimitMotion& motion, const BlockSystem& system);

}  // namespace ashlar

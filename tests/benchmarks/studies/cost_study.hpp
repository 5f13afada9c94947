// Time and memory of steps by size of the scene.
#pragma once

#include "apps/program/study/study.hpp"

namespace ashlar {

/// Extent of the study.
struct CostStudySize {
  int most_blocks = 1700;  ///< of floor, wall, pile and pyramid, >= 100
  int most_order = 8;      ///< of one cube at rest, 1 to PolynomialBasis::max_order
  int steps = 20;          ///< of 1/240 s, from the blocks as placed: > 0
};

/// Five scenes with a user's settings, on one thread: 1 floor (separate cubes on one slab), 2 wall (bricks in bond),
/// 3 pile (columns of cubes that fall 1 mm onto each other), 4 pyramid (each cube on four), 5 one cube on a slab by
/// its order. By scene and size: blocks, unknowns, contact points a step, seconds of processor time to build, seconds
/// a step, largest growth of the process in MiB. Each is run in a process of its own. Findings: exponents of time and
/// memory by number of blocks, or of unknowns.
/// @return holds is false if a scene could not be run to its end
/// @param progress receives each figure of cost_targets.hpp and each scene as soon as it is measured
[[nodiscard]] StudyResult study_cost(const StudyProgress& progress);
[[nodiscard]] StudyResult study_cost(const CostStudySize& size, const StudyProgress& progress);

}  // namespace ashlar

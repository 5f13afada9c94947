// What steps cost in time and memory against the size of a scene.
#pragma once

#include "apps/study/study.hpp"

namespace ashlar {

/// How far the study goes.
struct CostStudySize {
  int most_blocks = 3000;  ///< of floor, wall, pile and pyramid, >= 100
  int most_order = 8;      ///< of one cube at rest, 1 to PolynomialBasis::max_order
  int steps = 20;          ///< of 1/240 s, from the blocks as placed: > 0
};

/// Five scenes as a user would run them, on one thread: 1 floor (cubes apart on one slab), 2 wall (bricks in bond),
/// 3 pile (columns of cubes that fall 1 mm onto each other), 4 pyramid (each cube on four), 5 one cube on a slab by its
/// order. By scene and size: blocks, unknowns, contact points a step, seconds of processor time to build, seconds a
/// step, MiB that the process grew by at most. Each is run in a process of its own. Findings: exponents of time and
/// memory against blocks, or against unknowns. @return holds is false if a scene could not be run to its end
[[nodiscard]] StudyResult study_cost();
[[nodiscard]] StudyResult study_cost(const CostStudySize& size);

}  // namespace ashlar

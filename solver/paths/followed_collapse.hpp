// Rigid blocks that do not stand, followed until one has gone far or all rest.
//
// A step is the motion from rest by Gauss's principle (cone_program.hpp), scaled to a length in which no two blocks can meet
// undetected. Gaps of points in reach are shifts of the programme: what a step opens by dilation closes in the next one, and
// blocks that meet others stop there (as the path of a moving support, support_movement.hpp). Speeds are not kept: blocks
// end where slow motion ends, as in a static analysis.
//
// A static analysis needs hundreds of iterations for blocks that start slowly: inertia has to fall until they go far
// (notes/when_statics_end.md). This answers in some tens of programmes.
#pragma once

#include <vector>

#include "solver/paths/support_movement.hpp"

namespace ashlar {

enum class CollapseEnd {
  goes_far,   ///< a block has gone `far`
  rests,      ///< nothing moves any more
  undecided,  ///< a programme failed, or steps are used up
};

struct Collapse {
  CollapseEnd end = CollapseEnd::undecided;
  std::vector<double> displacements;  ///< of the centroids, by block, in block sizes
  int programmes = 0;
};

/// Joints have friction only: a caller asks for models without cohesion or tensile strength, and without bolts.
/// @param far in block sizes, > 0. @throws std::invalid_argument as support_movement
[[nodiscard]] Collapse follow_collapse(const PlacedScene& scene, double far);

}  // namespace ashlar

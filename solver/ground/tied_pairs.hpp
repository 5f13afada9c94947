// Pairs of blocks that a tie or a bond holds together over their common faces (tie.hpp), as placed.
#pragma once

#include "solver/state/automatic.hpp"
#include "solver/state/block_system.hpp"

namespace ashlar {

/// A tie for a simulation, with the stiffness of automatic_tie_stiffness().
/// @param a,b numbers of the blocks, a < b. @param source_a,source_b of these; one at least is not fixed
[[nodiscard]] TieRequest automatic_tie(int a, int b, const StiffnessSource& source_a,
                                       const StiffnessSource& source_b);

/// True if two blocks have a common face (common_faces.hpp). Without one a tie has no effect.
[[nodiscard]] bool have_common_face(const BlockModel& a, const BlockModel& b);

}  // namespace ashlar

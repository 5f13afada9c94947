// The joint pyramid of a block and the motion of a block in it; see key_block.hpp. Only sources of this layer
// include this file.
#pragma once

#include <vector>

#include "geometry/cutting/exact_plane.hpp"
#include "geometry/cutting/key_block.hpp"

namespace ashlar {

using IntegerVector = std::array<Integer, 3>;

/// True if there is an s other than zero with n . s <= 0 for all n.
[[nodiscard]] bool has_direction(const std::vector<IntegerVector>& normals);

/// A direction, exactly up to its length.
[[nodiscard]] IntegerVector in_integers(const Vector3& v);

/// @param held outward normals of the faces that restrain the block; KeyBlock::faces are indices into it.
/// @param free those of its other faces. @param force of any length but zero
[[nodiscard]] KeyBlock find_key_block(const std::vector<IntegerVector>& held,
                                      const std::vector<IntegerVector>& free, const Vector3& force);

}  // namespace ashlar

// Contact points between the blocks of a scene as rigid bodies (rigid_model.hpp).
#pragma once

#include <vector>

#include "solver/limit/rigid_model.hpp"

namespace ashlar {

/// Points of all pairs of blocks, in the order of the pairs. For programmes: corners of overlaps, single places, and
/// parts of overlaps with cohesion or tensile strength. As springs: points of affine_rule() on each overlap, and single
/// places with their tributary area. Pairs within a body and fixed pairs are excluded.
/// @param body_of by block; -1: fixed. @param areas for programmes: receives the triangles of all overlaps
[[nodiscard]] std::vector<RigidPoint> rigid_points(const BlockSystem& system, const RunState& state,
                                                   const std::vector<int>& body_of, RigidPointKind kind,
                                                   std::vector<RigidPoint>& areas);

}  // namespace ashlar

// Intersecting boxes, in O(N log^3 N + pairs found): the broad phase (theory.md section 6.1).
#pragma once

#include <array>
#include <vector>

#include "geometry/boxes/box.hpp"

namespace ashlar {

/// Pairs (i < j) of closed boxes that intersect, sorted. Empty boxes intersect none.
[[nodiscard]] std::vector<std::array<int, 2>> meeting_boxes(const std::vector<Box>& boxes);

/// Pairs (i, j) of a box of the first list that meets one of the second, sorted.
[[nodiscard]] std::vector<std::array<int, 2>> meeting_boxes(const std::vector<Box>& first,
                                                            const std::vector<Box>& second);

}  // namespace ashlar

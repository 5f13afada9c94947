// The one predicate behind overlap polygons: on which side of a line a point lies when seen along a
// direction.
#pragma once

#include <cstdint>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Who decided how many predicates.
struct PredicateCounts {
  std::uint64_t filter = 0;  ///< floating point with a proved error bound
  std::uint64_t exact = 0;   ///< exact arithmetic
  PredicateCounts& operator+=(const PredicateCounts& other) {
    filter += other.filter;
    exact += other.exact;
    return *this;
  }
};

/// Sign of det[b - a, c - a, w], exact for the given doubles: +1 if a, b, c turn counter-clockwise seen
/// against w (w pointing to the eye), 0 if they are in one plane with w (collinear when seen along w), else
/// -1.
/// @param counts is added to. Coordinates are finite; if products overflow the exact branch decides.
[[nodiscard]] int orientation_along(const Vector3& w, const Vector3& a, const Vector3& b, const Vector3& c,
                                    PredicateCounts& counts);

}  // namespace ashlar

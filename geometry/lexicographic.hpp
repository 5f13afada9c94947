// The order of points by their coordinates.
#pragma once

#include <algorithm>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// True if p comes before q: by the first coordinate in which they differ. A strict weak order of points without
/// coordinates that are not numbers.
[[nodiscard]] inline bool lexicographically_less(const Vector3& p, const Vector3& q) {
  return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
}

}  // namespace ashlar

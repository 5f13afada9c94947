// A plane that cuts rock.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// All x with normal . (x - point) = offset, exactly for the given doubles. The normal points to the side above.
struct CutPlane {
  Vector3 normal;       ///< not zero, any length
  Vector3 point;        ///< m
  double offset = 0.0;  ///< m times the length of the normal
};

/// The normal, upward and of unit length but for rounding, of a plane in the terms of geology. x is east, y
/// north and z up. Exact where both angles are multiples of 90 degrees.
/// @param dip degrees below the horizontal. @param dip_direction degrees from north towards east
[[nodiscard]] Vector3 plane_normal(double dip, double dip_direction);

}  // namespace ashlar

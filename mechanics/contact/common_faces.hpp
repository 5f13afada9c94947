// Faces that two solids have in common, as convex polygons.
#pragma once

#include <vector>

#include "geometry/solid/polyhedron.hpp"
#include "geometry/subfaces/view_frame.hpp"

namespace ashlar {

/// A part of a face of a that lies on a face of b.
struct CommonPolygon {
  int face_a;  ///< index into a.faces()
  int face_b;
  ViewFrame frame;                       ///< in the plane of face_a, w its outward normal
  std::vector<Eigen::Vector2d> corners;  ///< m, in the frame, counter-clockwise; at least 3

  /// A place in the frame as a point in space, m.
  [[nodiscard]] Vector3 point(const Eigen::Vector2d& place) const {
    return frame.origin + place.x() * frame.e1 + place.y() * frame.e2;
  }
};

/// Faces are common if they are coplanar within allowed_offset (face_selection.hpp), face each other and overlap, in
/// part or whole. The polygons do not overlap but for rounding, and their union is all of the common faces.
[[nodiscard]] std::vector<CommonPolygon> common_polygons(const Polyhedron& a, const Polyhedron& b);

/// True if two faces lie in one plane within allowed_offset and face each other, whether they overlap or not.
[[nodiscard]] bool faces_meet(const Polyhedron& a, const PolyhedronFace& face_a, const Polyhedron& b,
                              const PolyhedronFace& face_b);

}  // namespace ashlar

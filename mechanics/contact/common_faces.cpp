#include "mechanics/contact/common_faces.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/basis/plane_cross.hpp"
#include "mechanics/supports/face_selection.hpp"

namespace ashlar {
namespace {

/// Tolerance of opposite normals of faces that face each other: rounded corners tilt them by less.
constexpr double opposite_tolerance = 1e-6;

using Polygon = std::vector<Eigen::Vector2d>;

/// The part of a convex polygon to the left of a line. Parts of the edge due to rounding have negligible area.
Polygon clip_to_left(const Polygon& polygon, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  Polygon result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d& p = polygon[k];
    const Eigen::Vector2d& q = polygon[(k + 1) % polygon.size()];
    const double side_p = cross(to - from, p - from);
    const double side_q = cross(to - from, q - from);
    if (side_p >= 0.0) result.push_back(p);
    if ((side_p > 0.0 && side_q < 0.0) || (side_p < 0.0 && side_q > 0.0))
      result.emplace_back(p + side_p / (side_p - side_q) * (q - p));
  }
  return result;
}

Polygon triangle_of(const Polyhedron& solid, int triangle, const ViewFrame& frame) {
  Polygon corners;
  for (const int point : solid.mesh().triangles[static_cast<std::size_t>(triangle)])
    corners.push_back(frame.project(solid.mesh().points[static_cast<std::size_t>(point)]));
  return corners;
}

void add_common(const Polyhedron& a, int index_a, const Polyhedron& b, int index_b,
                std::vector<CommonPolygon>& result) {
  const PolyhedronFace& face_a = a.faces()[static_cast<std::size_t>(index_a)];
  const PolyhedronFace& face_b = b.faces()[static_cast<std::size_t>(index_b)];
  const auto first = static_cast<std::size_t>(face_a.loops[0][0]);
  const ViewFrame frame(a.mesh().points[first], face_a.normal);
  for (const int ta : face_a.triangles) {
    const Polygon of_a = triangle_of(a, ta, frame);
    for (const int tb : face_b.triangles) {
      Polygon common = triangle_of(b, tb, frame);
      // Seen from outside of a, triangles of b run clockwise.
      std::reverse(common.begin(), common.end());
      for (std::size_t k = 0; k < 3 && common.size() >= 3; ++k)
        common = clip_to_left(common, of_a[k], of_a[(k + 1) % 3]);
      if (common.size() < 3) continue;
      result.push_back({index_a, index_b, frame, std::move(common)});
    }
  }
}

}  // namespace

bool faces_meet(const Polyhedron& a, const PolyhedronFace& face_a, const Polyhedron& b,
                const PolyhedronFace& face_b) {
  if (face_a.normal.dot(face_b.normal) > opposite_tolerance - 1.0) return false;
  const Vector3& on_a = a.mesh().points[static_cast<std::size_t>(face_a.loops[0][0])];
  const double allowed = std::min(allowed_offset(a), allowed_offset(b));
  return std::all_of(face_b.loops[0].begin(), face_b.loops[0].end(), [&](int corner) {
    return std::abs(face_a.normal.dot(b.mesh().points[static_cast<std::size_t>(corner)] - on_a)) <= allowed;
  });
}

std::vector<CommonPolygon> common_polygons(const Polyhedron& a, const Polyhedron& b) {
  std::vector<CommonPolygon> result;
  for (std::size_t i = 0; i < a.faces().size(); ++i) {
    for (std::size_t j = 0; j < b.faces().size(); ++j) {
      if (faces_meet(a, a.faces()[i], b, b.faces()[j]))
        add_common(a, static_cast<int>(i), b, static_cast<int>(j), result);
    }
  }
  return result;
}

}  // namespace ashlar

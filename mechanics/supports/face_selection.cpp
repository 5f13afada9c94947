#include "mechanics/supports/face_selection.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "mechanics/basis/quadrature.hpp"

namespace ashlar {

double allowed_offset(const Polyhedron& solid) {
  Vector3 low = solid.mesh().points.front();
  Vector3 high = low;
  for (const Vector3& point : solid.mesh().points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return placement_tolerance * (high - low).norm();
}

std::vector<int> faces_in_plane(const Polyhedron& solid, const Plane& plane) {
  const double length = plane.normal.stableNorm();
  if (!(length > 0.0) || !std::isfinite(length))
    throw std::invalid_argument("a plane needs a finite, non-zero normal");
  const Vector3 normal = plane.normal / length;
  const double tolerance = allowed_offset(solid);
  std::vector<int> result;
  for (std::size_t f = 0; f < solid.faces().size(); ++f) {
    bool inside = true;
    for (const auto& loop : solid.faces()[f].loops) {
      for (const int vertex : loop) {
        const Vector3& point = solid.mesh().points[static_cast<std::size_t>(vertex)];
        inside = inside && std::abs(normal.dot(point - plane.point)) <= tolerance;
      }
    }
    if (inside) result.push_back(static_cast<int>(f));
  }
  return result;
}

std::vector<int> faces_at(const Polyhedron& solid, const BlockPlace& place) {
  if (const auto* plane = std::get_if<Plane>(&place)) return faces_in_plane(solid, *plane);
  const auto* list = std::get_if<FaceList>(&place);
  if (list == nullptr) return {};
  for (const int face : list->faces) {
    if (face < 0 || face >= static_cast<int>(solid.faces().size()))
      throw std::invalid_argument("a face index is not one of the solid");
  }
  return list->faces;
}

SurfaceRule surface_rule(const Polyhedron& solid, const std::vector<int>& faces, int degree) {
  const TriangleRule rule = triangle_rule(degree);
  SurfaceRule result;
  for (const int face : faces) {
    for (const int t : solid.faces()[static_cast<std::size_t>(face)].triangles) {
      const auto& triangle = solid.mesh().triangles[static_cast<std::size_t>(t)];
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k)
        corners.col(k) = solid.mesh().points[static_cast<std::size_t>(triangle[static_cast<std::size_t>(k)])];
      const double area =
          0.5 * (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm();
      for (std::size_t q = 0; q < rule.weights.size(); ++q) {
        result.points.emplace_back(corners * rule.barycentric[q]);
        result.weights.push_back(area * rule.weights[q]);
      }
    }
  }
  return result;
}

}  // namespace ashlar

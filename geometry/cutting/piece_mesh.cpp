#include "geometry/cutting/piece_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "geometry/mesh/polygon_triangulation.hpp"

namespace ashlar {
namespace {

double distance_from_segment(const Vector3& x, const Vector3& from, const Vector3& to) {
  const Vector3 along = to - from;
  const double size = along.squaredNorm();
  const double share = size > 0.0 ? std::clamp(along.dot(x - from) / size, 0.0, 1.0) : 0.0;
  return (from + share * along - x).norm();
}

/// Where an edge goes through a plane, by rounded heights of its ends.
Vector3 crossing(const ExactPlane& plane, const Vector3& from, const Vector3& to) {
  const Vector3 normal = plane.unit_normal();
  const auto& [a, b, c, d] = plane.coefficients();
  const double height = Rational(d, 1).get_d() / Vector3(a.get_d(), b.get_d(), c.get_d()).norm();
  const double low = normal.dot(from) - height, high = normal.dot(to) - height;
  if (low == high) return from;
  return from + std::clamp(low / (low - high), 0.0, 1.0) * (to - from);
}

}  // namespace

TriangleMesh mesh_of_faces(const CellComplex& complex, const std::vector<std::pair<int, bool>>& faces) {
  TriangleMesh mesh;
  std::map<std::array<double, 3>, int> places;
  for (const auto& [index, below] : faces) {
    std::vector<Vector3> corners;
    for (const int point : complex.face(index).points) {
      const Vector3& place = complex.point(point).place.rounded;
      if (corners.empty() || (corners.back() != place && corners.front() != place)) corners.push_back(place);
    }
    if (corners.size() < 3) continue;
    std::vector<int> loop(corners.size());
    std::iota(loop.begin(), loop.end(), 0);
    std::vector<std::array<int, 3>> triangles;
    std::size_t tests_left = std::numeric_limits<std::size_t>::max();
    triangulate_polygon(corners, loop, triangles, tests_left);
    for (auto& triangle : triangles) {
      for (int& corner : triangle) {
        const Vector3& place = corners[corner];
        const auto [found, is_new] =
            places.emplace(std::array{place.x(), place.y(), place.z()}, static_cast<int>(mesh.points.size()));
        if (is_new) mesh.points.push_back(place);
        corner = found->second;
      }
      if (!below) std::swap(triangle[1], triangle[2]);
      mesh.triangles.push_back(triangle);
    }
  }
  return mesh;
}

double distance_from_section(const CellComplex& complex, int cell, const ExactPlane& plane,
                             const ExactPoint& from) {
  double nearest = std::numeric_limits<double>::infinity();
  bool above = false, below = false, inside = true;
  for (const int index : complex.faces(cell)) {
    const ComplexFace& face = complex.face(index);
    inside = inside && complex.plane(face.plane).side(from) * (face.cells[0] == cell ? 1 : -1) <= 0;
    std::vector<Vector3> ends;
    for (std::size_t k = 0; k < face.points.size(); ++k) {
      const ExactPoint& a = complex.point(face.points[k]).place;
      const ExactPoint& b = complex.point(face.points[(k + 1) % face.points.size()]).place;
      const int of_a = plane.side(a), of_b = plane.side(b);
      above = above || of_a > 0;
      below = below || of_a < 0;
      if (of_a == 0) ends.push_back(a.rounded);
      if (of_a * of_b < 0) ends.push_back(crossing(plane, a.rounded, b.rounded));
    }
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      nearest = std::min(nearest, distance_from_segment(from.rounded, ends[k], ends[k + 1]));
  }
  if (!above || !below) return std::numeric_limits<double>::infinity();
  return inside ? 0.0 : nearest;
}

}  // namespace ashlar

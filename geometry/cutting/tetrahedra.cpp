#include "geometry/cutting/tetrahedra.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>

#include "geometry/boxes/box.hpp"
#include "geometry/cutting/convex_parts.hpp"
#include "geometry/cutting/cut_solid.hpp"
#include "geometry/cutting/piece_mesh.hpp"
#include "geometry/cutting/surface_partition.hpp"
#include "geometry/exact/rounding_mode.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<std::array<int, 3>>;

Kernel::Point_3 to_cgal(const Vector3& p) {
  return {p.x(), p.y(), p.z()};
}

/// True if a point is below an outward triangle.
bool sees(const Vector3& from, const Vector3& a, const Vector3& b, const Vector3& c) {
  return CGAL::orientation(to_cgal(from), to_cgal(a), to_cgal(b), to_cgal(c)) == CGAL::POSITIVE;
}

bool sees_all(const Vector3& from, const TriangleMesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& corners) {
    const auto& [a, b, c] = corners;
    return sees(from, mesh.points[at(a)], mesh.points[at(b)], mesh.points[at(c)]);
  });
}

/// Centroid of the body bounded by outward triangles, or the mean of their corners if it has no volume.
Vector3 centroid_of(const std::vector<Vector3>& points, const Triangles& triangles) {
  Vector3 mean = Vector3::Zero();
  for (const auto& triangle : triangles)
    for (const int corner : triangle) mean += points[at(corner)];
  mean /= 3.0 * static_cast<double>(triangles.size());
  Vector3 sum = Vector3::Zero();
  double volume = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const Vector3 x = points[at(a)] - mean, y = points[at(b)] - mean, z = points[at(c)] - mean;
    const double part = x.cross(y).dot(z);
    volume += part;
    sum += part / 4.0 * (x + y + z);
  }
  return volume > 0.0 ? Vector3(mean + sum / volume) : mean;
}

/// The surface of a cell, outward, without triangles whose corners coincide. @param index_of a point of the complex
template <class IndexOf>
Triangles surface_of(const CellComplex& complex, int cell, IndexOf index_of) {
  Triangles outward;
  for (const int index : complex.faces(cell)) {
    const ComplexFace& face = complex.face(index);
    for (auto triangle : triangles_of_face(complex, index)) {
      for (int& corner : triangle) corner = index_of(face.points[at(corner)]);
      if (face.cells[0] != cell) std::swap(triangle[1], triangle[2]);
      const auto& [a, b, c] = triangle;
      if (a != b && b != c && c != a) outward.push_back(triangle);
    }
  }
  return outward;
}

/// The centroid of all points below every triangle's plane: the remainder of a box cut by these.
std::optional<Vector3> centroid_of_kernel(const TriangleMesh& mesh) {
  CellComplex complex;
  const int cell = add_box_around(complex, mesh);
  for (const auto& [a, b, c] : mesh.triangles) {
    const int plane = complex.add_plane(ExactPlane::through(
        to_rational(mesh.points[at(a)]), to_rational(mesh.points[at(b)]), to_rational(mesh.points[at(c)])));
    const int side = complex.side_of_cell(plane, cell);
    if (side > 0) return std::nullopt;
    if (side == 0) complex.remove(complex.part(cell, plane, -1));
  }
  std::vector<Vector3> points;
  const Triangles surface = surface_of(complex, cell, [&](int point) {
    points.push_back(complex.point(point).place.rounded);
    return static_cast<int>(points.size()) - 1;
  });
  return centroid_of(points, surface);
}

std::optional<Vector3> point_that_sees(const Polyhedron& solid) {
  const Vector3 centroid = centroid_of(solid.mesh().points, solid.mesh().triangles);
  if (sees_all(centroid, solid.mesh())) return centroid;
  if (solid.convex()) return std::nullopt;
  const std::optional<Vector3> inner = centroid_of_kernel(solid.mesh());
  return inner && sees_all(*inner, solid.mesh()) ? inner : std::nullopt;
}

/// Removes cells without volume, or with a height below the resolution of the coordinates.
void keep_thick(TetrahedronMesh& mesh, double resolution) {
  std::erase_if(mesh.cells, [&](const std::array<int, 4>& cell) {
    std::array<Vector3, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = mesh.points[at(cell[k])];
    double largest = 0.0;  // twice the area of a face
    for (std::size_t k = 0; k < 4; ++k)
      largest = std::max(largest, (x[(k + 1) % 4] - x[k]).cross(x[(k + 2) % 4] - x[k]).norm());
    const double volume = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]);
    return !(volume > resolution * largest) || !sees(x[0], x[1], x[2], x[3]);
  });
}

/// The convex cells of a solid, with their corners rounded.
class CellStars {
 public:
  CellStars(const Polyhedron& solid, double resolution)
      : cells_(convex_parts(complex_, complex_.add_cell(solid.mesh()), -1, most_surface_cells)),
        merged_(merge_points(complex_, resolution)),
        resolution_(resolution) {}

  [[nodiscard]] TetrahedronMesh take() {
    for (const int cell : cells_) add_star(cell);
    keep_thick(result_, resolution_);
    return std::move(result_);
  }

 private:
  void add_star(int cell) {
    const Triangles outward = surface_of(complex_, cell, [this](int of) { return point(of); });
    if (outward.size() < 4) return;  // its corners coincide
    const Vector3 centre = centroid_of(result_.points, outward);
    const int centre_index = static_cast<int>(result_.points.size());
    result_.points.push_back(centre);
    for (const auto& [a, b, c] : outward) result_.cells.push_back({centre_index, a, b, c});
  }

  int point(int of_complex) {
    const int first = merged_[at(of_complex)];
    const auto [found, is_new] = index_.emplace(first, static_cast<int>(result_.points.size()));
    if (is_new) result_.points.push_back(complex_.point(first).place.rounded);
    return found->second;
  }

  CellComplex complex_;
  std::vector<int> cells_;
  std::vector<int> merged_;
  double resolution_;
  std::map<int, int> index_;  ///< in result_, by point of the complex
  TetrahedronMesh result_;
};

// Not inlined into the function that changes the rounding mode.
[[gnu::noinline]] TetrahedronMesh make_tetrahedra(const Polyhedron& solid, double resolution) {
  const std::optional<Vector3> centre = point_that_sees(solid);
  if (!centre) return CellStars(solid, resolution).take();
  TetrahedronMesh star{solid.mesh().points, {}};
  const int index = static_cast<int>(star.points.size());
  star.points.push_back(*centre);
  for (const auto& [a, b, c] : solid.mesh().triangles) star.cells.push_back({index, a, b, c});
  return star;
}

}  // namespace

TetrahedronMesh tetrahedra_of(const Polyhedron& solid, double resolution) {
  const NearestRounding nearest;
  return make_tetrahedra(solid, resolution);
}

TetrahedronMesh translated(TetrahedronMesh mesh, const Vector3& by) {
  const NearestRounding nearest;
  for (Vector3& point : mesh.points) point += by;
  keep_thick(mesh, 0.0);
  return mesh;
}

}  // namespace ashlar

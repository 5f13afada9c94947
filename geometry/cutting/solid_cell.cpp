#include <algorithm>
#include <map>

#include "geometry/cutting/cell_complex.hpp"
#include "geometry/cutting/plane_regions.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {
namespace {

/// A surface with the planes of its triangles, whose points are distinguished by their places.
class FlatFaces {
 public:
  /// @param points of the surface: in the complex. @param planes of its triangles
  FlatFaces(CellComplex& complex, const TriangleMesh& surface, const std::vector<int>& points,
            const std::vector<int>& planes)
      : complex_(complex), planes_(planes), united_(surface.triangles.size()) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int from = points[surface.triangles[t][k]], to = points[surface.triangles[t][(k + 1) % 3]];
        edges_[std::minmax(from, to)].push_back({static_cast<int>(t), from, to});
      }
    }
    for (const auto& [ends, uses] : edges_)
      if (is_flat(uses)) united_.unite(uses[0].triangle, uses[1].triangle);
  }

  /// @return the faces
  [[nodiscard]] std::vector<int> make() {
    std::map<int, std::vector<OutlineSide>> outlines;
    for (const auto& [ends, uses] : edges_) {
      if (is_flat(uses)) continue;
      const int edge = complex_.add_edge(ends.first, ends.second, planes_along(uses));
      for (const Use& use : uses) outlines[united_.find(use.triangle)].push_back({use.from, use.to, edge});
    }
    std::vector<int> faces;
    for (const auto& [triangle, sides] : outlines)
      for (FaceOutline& outline : plane_regions(complex_, complex_.plane(planes_[triangle]), sides))
        faces.push_back(complex_.add_face(planes_[triangle], std::move(outline), -1));
    return faces;
  }

 private:
  struct Use {
    int triangle, from, to;
  };

  [[nodiscard]] bool is_flat(const std::vector<Use>& uses) const {
    return uses.size() == 2 && planes_[uses[0].triangle] == planes_[uses[1].triangle];
  }

  /// Two planes that are not parallel.
  [[nodiscard]] std::array<int, 2> planes_along(const std::vector<Use>& uses) const {
    const int first = planes_[uses.front().triangle];
    const RationalVector normal = complex_.plane(first).normal();
    const auto other = std::find_if(uses.begin(), uses.end(), [&](const Use& use) {
      return !is_zero(cross_product(normal, complex_.plane(planes_[use.triangle]).normal()));
    });
    return {first, planes_[(other == uses.end() ? uses.back() : *other).triangle]};
  }

  CellComplex& complex_;
  const std::vector<int>& planes_;
  UnionFind united_;
  std::map<std::pair<int, int>, std::vector<Use>> edges_;
};

}  // namespace

int CellComplex::add_cell(const TriangleMesh& surface) {
  std::map<std::array<double, 3>, int> places;
  std::vector<int> points, planes;
  for (const Vector3& x : surface.points) {
    const Vector3 place = x + Vector3::Zero();  // no -0
    const auto [found, is_new] = places.emplace(std::array{place.x(), place.y(), place.z()}, -1);
    if (is_new) found->second = add_point({ExactPoint::of(place), {}});
    points.push_back(found->second);
  }
  std::map<std::array<Integer, 4>, int> known;
  for (const auto& corners : surface.triangles) {
    std::array<RationalVector, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = to_rational(surface.points[corners[k]]);
    const ExactPlane plane = ExactPlane::through(x[0], x[1], x[2]);
    const auto [found, is_new] = known.emplace(plane.coefficients(), -1);
    if (is_new) found->second = add_plane(plane);
    planes.push_back(found->second);
    for (const int corner : corners) points_[points[corner]].planes.push_back(found->second);
  }
  const int cell = add_cell(false);
  std::vector<std::pair<int, bool>> faces;
  for (const int face : FlatFaces(*this, surface, points, planes).make()) faces.emplace_back(face, true);
  set_faces(cell, faces);
  return cell;
}

}  // namespace ashlar

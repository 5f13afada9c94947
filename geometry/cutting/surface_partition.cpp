#include "geometry/cutting/surface_partition.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "geometry/boxes/box.hpp"
#include "geometry/cutting/cut_error.hpp"
#include "geometry/solid/shapes.hpp"
#include "geometry/solid/solid_location.hpp"

namespace ashlar {
namespace {

/// A convex polygon in a plane, by the planes of its sides: side k goes from point k to point k + 1.
struct FlatPolygon {
  const ExactPlane* plane;
  std::vector<const ExactPlane*> sides;
  std::vector<ExactPoint> points;
};

/// Keeps the part on one side of a plane. @return false if it has no inner point
bool clip(FlatPolygon& polygon, const ExactPlane& by, int inner) {
  const std::size_t count = polygon.points.size();
  std::vector<int> sides;
  for (const ExactPoint& point : polygon.points) sides.push_back(by.side(point) * inner);
  if (std::find(sides.begin(), sides.end(), 1) == sides.end()) return false;
  if (std::find(sides.begin(), sides.end(), -1) == sides.end()) return true;
  FlatPolygon rest{polygon.plane, {}, {}};
  for (std::size_t k = 0; k < count; ++k) {
    const int here = sides[k], there = sides[(k + 1) % count];
    if (here >= 0) {
      rest.points.push_back(polygon.points[k]);
      rest.sides.push_back(here == 0 && there < 0 ? &by : polygon.sides[k]);
    }
    if (here * there >= 0) continue;
    rest.points.push_back(*common_point(*polygon.plane, *polygon.sides[k], by));
    rest.sides.push_back(here > 0 ? &by : polygon.sides[k]);
  }
  polygon = std::move(rest);
  return true;
}

/// A triangle of the surface with the planes through its sides, below which it lies.
struct Facet {
  ExactPlane plane;
  std::array<ExactPlane, 3> sides;
  std::array<ExactPoint, 3> corners;
  Box box;
  int index = -1;  ///< of the plane in the complex, once added
};

Facet make_facet(const Vector3& a, const Vector3& b, const Vector3& c) {
  const std::array<RationalVector, 3> x = {to_rational(a), to_rational(b), to_rational(c)};
  const RationalVector normal = cross_product(difference(x[1], x[0]), difference(x[2], x[0]));
  const auto side = [&](int k) {
    const RationalVector inward = cross_product(normal, difference(x[(k + 1) % 3], x[k]));
    return ExactPlane(inward, dot_product(inward, x[k]));
  };
  return {ExactPlane::through(x[0], x[1], x[2]),
          {side(0), side(1), side(2)},
          {ExactPoint::of(a), ExactPoint::of(b), ExactPoint::of(c)},
          box_of(std::array{a, b, c}),
          -1};
}

class SurfacePartition {
 public:
  SurfacePartition(CellComplex& complex, const TriangleMesh& surface, int mark, int most_cells)
      : complex_(complex), surface_(surface), mark_(mark), most_cells_(most_cells) {
    const std::vector<Vector3>& x = surface.points;
    for (const auto& [a, b, c] : surface.triangles) facets_.push_back(make_facet(x[a], x[b], x[c]));
  }

  [[nodiscard]] std::vector<CellSide> of(int cell) {
    std::vector<CellSide> leaves;
    std::vector<int> all;
    for (int f = 0; f < static_cast<int>(facets_.size()); ++f) all.push_back(f);
    std::vector<std::pair<int, std::vector<int>>> open;
    open.emplace_back(cell, passing(cell, all));
    while (!open.empty()) {
      auto [next, facets] = std::move(open.back());
      open.pop_back();
      if (facets.empty()) {
        leaves.push_back({next, is_inside_surface(next)});
        continue;
      }
      const int upper = complex_.part(next, plane_of(best_of(facets)), mark_);
      if (complex_.cell_count() > most_cells_)
        throw CutError("cutting along a surface makes too many cells (" + std::to_string(most_cells_) +
                       " and more), a surface of fewer triangles is needed");
      open.emplace_back(upper, passing(upper, facets));
      open.emplace_back(next, passing(next, facets));
    }
    return leaves;
  }

 private:
  /// Facets that pass through inner points of a cell.
  [[nodiscard]] std::vector<int> passing(int cell, const std::vector<int>& facets) const {
    Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const int point : complex_.points_of(cell)) {
      low = low.cwiseMin(complex_.point(point).place.rounded);
      high = high.cwiseMax(complex_.point(point).place.rounded);
    }
    std::vector<int> result;
    for (const int f : facets)
      if (facets_[f].box.meets({low, high}) && passes(cell, facets_[f])) result.push_back(f);
    return result;
  }

  [[nodiscard]] bool passes(int cell, const Facet& facet) const {
    FlatPolygon polygon{&facet.plane,
                        {&facet.sides[0], &facet.sides[1], &facet.sides[2]},
                        {facet.corners.begin(), facet.corners.end()}};
    const std::vector<int>& faces = complex_.faces(cell);
    return std::all_of(faces.begin(), faces.end(), [&](int index) {
      const ComplexFace& face = complex_.face(index);
      return clip(polygon, complex_.plane(face.plane), face.cells[0] == cell ? -1 : 1);
    });
  }

  /// The facet, of the first few, whose plane crosses the fewest others.
  [[nodiscard]] int best_of(const std::vector<int>& facets) const {
    constexpr std::size_t looked_at = 12;
    int best = facets.front();
    std::size_t fewest = facets.size() + 1;
    for (std::size_t k = 0; k < std::min(looked_at, facets.size()); ++k) {
      const ExactPlane& plane = facets_[facets[k]].plane;
      const auto crossed = static_cast<std::size_t>(std::count_if(facets.begin(), facets.end(), [&](int f) {
        const auto& corners = facets_[f].corners;
        const int a = plane.side(corners[0]), b = plane.side(corners[1]), c = plane.side(corners[2]);
        return std::min({a, b, c}) < 0 && std::max({a, b, c}) > 0;
      }));
      if (crossed >= fewest) continue;
      fewest = crossed;
      best = facets[k];
    }
    return best;
  }

  /// Facets in one plane share it.
  [[nodiscard]] int plane_of(int facet) {
    Facet& of = facets_[facet];
    if (of.index < 0) {
      const auto [place, is_new] = planes_.emplace(of.plane.coefficients(), -1);
      if (is_new) place->second = complex_.add_plane(of.plane);
      of.index = place->second;
    }
    return of.index;
  }

  [[nodiscard]] bool is_inside_surface(int cell) const {
    const std::vector<int> points = complex_.points_of(cell);
    Vector3 sum = Vector3::Zero();
    for (const int point : points) sum += complex_.point(point).place.rounded;
    const Vector3 middle = sum / static_cast<double>(points.size());
    return is_inner(cell, ExactPoint::of(middle)) ? is_inside(surface_, middle)
                                                  : is_inside_exactly(cell, points);
  }

  [[nodiscard]] bool is_inner(int cell, const ExactPoint& place) const {
    const std::vector<int>& faces = complex_.faces(cell);
    return std::all_of(faces.begin(), faces.end(), [&](int index) {
      const ComplexFace& face = complex_.face(index);
      return complex_.plane(face.plane).side(place) == (face.cells[0] == cell ? -1 : 1);
    });
  }

  /// The mean of points with coordinates truncated to multiples of a power of two.
  [[nodiscard]] ExactPoint mean_of(const std::vector<int>& points, unsigned long bits) const {
    std::array<Integer, 3> sum = {0, 0, 0};
    for (const int point : points) {
      const ExactPoint& place = complex_.point(point).place;
      const std::array<const Integer*, 3> x = {&place.x, &place.y, &place.z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Integer cut_off = *x[axis] << bits;
        mpz_fdiv_q(cut_off.get_mpz_t(), cut_off.get_mpz_t(), place.w.get_mpz_t());
        sum[axis] += cut_off;
      }
    }
    ExactPoint mean{sum[0], sum[1], sum[2], Integer(static_cast<unsigned long>(points.size())) << bits, {}};
    mean.rounded = round_to_nearest(mean.rational());
    return mean;
  }

  /// For a cell too thin for a rounded inner point: an inner point with as many bits as needed, and the parity of
  /// crossings with a ray from it, in a direction that meets no edge. The exact mean would have the product of all
  /// denominators.
  [[nodiscard]] bool is_inside_exactly(int cell, const std::vector<int>& points) const {
    unsigned long bits = 128;
    ExactPoint inner = mean_of(points, bits);
    while (!is_inner(cell, inner)) inner = mean_of(points, bits *= 2);
    const RationalVector mean = inner.rational();
    for (long turn = 1;; ++turn) {
      const RationalVector ray{Rational(1), Rational(turn, 7), Rational(3, turn + 10)};
      const std::optional<bool> odd = parity_along(mean, ray);
      if (odd) return *odd;
    }
  }

  [[nodiscard]] std::optional<bool> parity_along(const RationalVector& from,
                                                 const RationalVector& ray) const {
    bool odd = false;
    for (const auto& corners : surface_.triangles) {
      std::array<RationalVector, 3> x;
      for (std::size_t k = 0; k < 3; ++k) x[k] = difference(to_rational(surface_.points[corners[k]]), from);
      std::array<int, 3> turns{};
      for (std::size_t k = 0; k < 3; ++k)
        turns[k] = sgn(dot_product(ray, cross_product(x[k], x[(k + 1) % 3])));
      const auto [least, most] = std::minmax({turns[0], turns[1], turns[2]});
      if (least < 0 && most > 0) continue;
      const RationalVector normal = cross_product(difference(x[1], x[0]), difference(x[2], x[0]));
      const int sense = sgn(dot_product(normal, ray)) * sgn(dot_product(normal, x[0]));
      if (least == 0 || most == 0) return std::nullopt;
      if (sense > 0) odd = !odd;
    }
    return odd;
  }

  CellComplex& complex_;
  const TriangleMesh& surface_;
  int mark_, most_cells_;
  std::vector<Facet> facets_;
  std::map<std::array<Integer, 4>, int> planes_;  ///< in the complex, by coefficients
};

}  // namespace

std::vector<CellSide> partition_by_surface(CellComplex& complex, const std::vector<int>& cells,
                                           const TriangleMesh& surface, int mark, int most_cells) {
  SurfacePartition partition(complex, surface, mark, most_cells);
  std::vector<CellSide> leaves;
  for (const int cell : cells) {
    const std::vector<CellSide> parts = partition.of(cell);
    leaves.insert(leaves.end(), parts.begin(), parts.end());
  }
  return leaves;
}

int add_box_around(CellComplex& complex, const TriangleMesh& surface) {
  const Box box = box_of(surface.points);
  const Box around = box.grown((box.high - box.low).maxCoeff());
  return complex.add_cell(ConvexShape::from_mesh(make_box(around.low, around.high)));
}

}  // namespace ashlar

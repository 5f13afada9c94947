#include "geometry/solid/self_intersection.hpp"

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace ashlar {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<int, 3>;

Point to_point(const Vector3& p) {
  return {p.x(), p.y(), p.z()};
}

enum class Cone { outside, boundary, inside };

// Location of the ray from o through p in the cone of a triangle; sign is the orientation of (o, a, b, c).
Cone locate_in_cone(const Point& o, const std::array<Point, 3>& t, const Point& p, CGAL::Orientation sign) {
  bool boundary = false;
  for (int k = 0; k < 3; ++k) {
    const CGAL::Orientation side = CGAL::orientation(o, t[k], t[(k + 1) % 3], p);
    if (side == -sign) return Cone::outside;
    boundary = boundary || side == CGAL::ZERO;
  }
  return boundary ? Cone::boundary : Cone::inside;
}

class PairTest {
 public:
  PairTest(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles)
      : points_(points), triangles_(triangles) {}

  // The common points decide which part may still be met: opposite an edge it is the other corner, opposite a
  // corner the other side, and a convex common set larger than a corner always reaches that side.
  [[nodiscard]] bool operator()(int i, int j) const {
    Triangle a = triangles_[i];
    Triangle b = triangles_[j];
    const int common = move_common_to_front(a, b);
    if (common == 3) return true;
    if (common == 2) return overlap_over_edge(a, b);
    if (common == 1) {
      return CGAL::do_intersect(segment(a[1], a[2]), triangle(b)) ||
             CGAL::do_intersect(segment(b[1], b[2]), triangle(a));
    }
    return CGAL::do_intersect(triangle(a), triangle(b));
  }

 private:
  [[nodiscard]] Point point(int v) const { return to_point(points_[v]); }
  [[nodiscard]] Kernel::Segment_3 segment(int u, int v) const { return {point(u), point(v)}; }
  [[nodiscard]] Kernel::Triangle_3 triangle(const Triangle& t) const {
    return {point(t[0]), point(t[1]), point(t[2])};
  }

  static int move_common_to_front(Triangle& a, Triangle& b) {
    int common = 0;
    for (int k = 0; k < 3; ++k) {
      auto* const found = std::find(b.begin() + common, b.end(), a[k]);
      if (found == b.end()) continue;
      std::iter_swap(b.begin() + common, found);
      std::swap(a[common], a[k]);
      ++common;
    }
    return common;
  }

  [[nodiscard]] bool overlap_over_edge(const Triangle& a, const Triangle& b) const {
    const Point p = point(a[0]);
    const Point q = point(a[1]);
    const Point r = point(a[2]);
    const Point s = point(b[2]);
    return CGAL::orientation(p, q, r, s) == CGAL::COPLANAR &&
           CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  }

  const std::vector<Vector3>& points_;
  const std::vector<Triangle>& triangles_;
};

// Ends the box search, which has no other way to stop early.
struct EnoughPairs {};

}  // namespace

bool is_star_shaped(const TriangleMesh& mesh) {
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : mesh.points) mean += p / static_cast<double>(mesh.points.size());
  const Point o = to_point(mean);
  const auto corners = [&mesh](const Triangle& t) {
    return std::array<Point, 3>{to_point(mesh.points[t[0]]), to_point(mesh.points[t[1]]),
                                to_point(mesh.points[t[2]])};
  };
  // Unequal weights keep the ray off the planes of symmetry, where triangles of regular solids have edges.
  const Triangle& first = mesh.triangles.front();
  const Point aim =
      to_point((4.0 * mesh.points[first[0]] + 2.0 * mesh.points[first[1]] + mesh.points[first[2]]) / 7.0);

  CGAL::Orientation common = CGAL::ZERO;
  int crossings = 0;
  for (const Triangle& t : mesh.triangles) {
    const std::array<Point, 3> abc = corners(t);
    const CGAL::Orientation sign = CGAL::orientation(o, abc[0], abc[1], abc[2]);
    if (common == CGAL::ZERO) common = sign;
    if (sign == CGAL::ZERO || sign != common) return false;
    const Cone place = locate_in_cone(o, abc, aim, sign);
    if (place == Cone::boundary) return false;
    if (place == Cone::inside && ++crossings > 1) return false;
  }
  return crossings == 1;
}

bool is_degenerate(const std::vector<Vector3>& points, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return a == b || b == c || c == a ||
         CGAL::collinear(to_point(points[a]), to_point(points[b]), to_point(points[c]));
}

std::vector<std::array<int, 2>> self_intersections(const std::vector<Vector3>& points,
                                                   const std::vector<Triangle>& triangles, std::size_t limit,
                                                   std::size_t candidates) {
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, std::vector<Triangle>::const_iterator>;
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (auto t = triangles.begin(); t != triangles.end(); ++t) {
    boxes.emplace_back(to_point(points[(*t)[0]]).bbox() + to_point(points[(*t)[1]]).bbox() +
                           to_point(points[(*t)[2]]).bbox(),
                       t);
  }
  std::vector<std::array<int, 2>> pairs;
  const PairTest meet(points, triangles);
  std::size_t tested = 0;
  const auto visit = [&](const Box& x, const Box& y) {
    if (tested++ >= candidates) throw EnoughPairs{};
    const auto [i, j] = std::minmax(
        {static_cast<int>(x.handle() - triangles.begin()), static_cast<int>(y.handle() - triangles.begin())});
    if (!meet(i, j)) return;
    pairs.push_back({i, j});
    if (pairs.size() >= limit) throw EnoughPairs{};
  };
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), visit);
  } catch (const EnoughPairs&) {
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace ashlar

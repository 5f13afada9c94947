#include "geometry/cutting/piece_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "geometry/mesh/polygon_triangulation.hpp"
#include "geometry/union_find.hpp"

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

/// A face's loop seen along the axis nearest to its normal, turned so that it is counter-clockwise.
class FlatLoop {
 public:
  FlatLoop(const CellComplex& complex, const ComplexFace& face) : complex_(complex), face_(face) {
    const auto& [a, b, c, d] = complex.plane(face.plane).coefficients();
    const std::array<const Integer*, 3> normal = {&a, &b, &c};
    for (std::size_t k = 1; k < 3; ++k)
      if (mpz_cmpabs(normal[k]->get_mpz_t(), normal[axis_]->get_mpz_t()) > 0) axis_ = k;
    way_ = sgn(*normal[axis_]);
  }

  /// 1 if the loop's points i, j, k make a left turn, 0 if they are in one line.
  [[nodiscard]] int turn(int i, int j, int k) const {
    const std::array<const ExactPoint*, 3> p = {&at(i), &at(j), &at(k)};
    if (const int quick = quick_turn(p[0]->rounded, p[1]->rounded, p[2]->rounded)) return quick;
    const auto minor = [&](std::size_t m, std::size_t n) {
      return Integer(first(*p[m]) * second(*p[n]) - second(*p[m]) * first(*p[n]));
    };
    const Integer determinant = p[0]->w * minor(1, 2) - p[1]->w * minor(0, 2) + p[2]->w * minor(0, 1);
    return way_ * sgn(determinant);
  }

 private:
  [[nodiscard]] const ExactPoint& at(int k) const {
    return complex_.point(face_.points[static_cast<std::size_t>(k)]).place;
  }
  [[nodiscard]] const Integer& first(const ExactPoint& p) const {
    return axis_ == 0 ? p.y : axis_ == 1 ? p.z : p.x;
  }
  [[nodiscard]] const Integer& second(const ExactPoint& p) const {
    return axis_ == 0 ? p.z : axis_ == 1 ? p.x : p.y;
  }
  /// Each coordinate is off by u, each difference by u more, products and their difference by two more: less
  /// than 12 u times the largest coordinate times the sum of the differences. 0: it does not tell.
  [[nodiscard]] int quick_turn(const Vector3& a, const Vector3& b, const Vector3& c) const {
    const auto u = static_cast<Eigen::Index>((axis_ + 1) % 3), v = static_cast<Eigen::Index>((axis_ + 2) % 3);
    const double p = b[u] - a[u], q = b[v] - a[v], r = c[u] - a[u], s = c[v] - a[v];
    const double value = p * s - q * r;
    const double largest =
        std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
    const double bound =
        12.0 * 0x1p-53 * largest * (std::abs(p) + std::abs(q) + std::abs(r) + std::abs(s)) + 0x1p-1000;
    return value > bound ? way_ : value < -bound ? -way_ : 0;
  }

  const CellComplex& complex_;
  const ComplexFace& face_;
  std::size_t axis_ = 0;
  int way_ = 1;
};

/// Triangles of a convex loop that may have points in its straight sides. A corner is cut off where that
/// leaves some area and takes some, decided on the exact points: else a point in the side of two faces could
/// get a sliver of a triangle in both, one upon the other.
std::vector<std::array<int, 3>> triangles_of(const CellComplex& complex, const ComplexFace& face) {
  const FlatLoop flat(complex, face);
  std::vector<int> loop(face.points.size());
  std::iota(loop.begin(), loop.end(), 0);
  std::vector<std::array<int, 3>> triangles;
  const auto is_ear = [&](std::size_t k) {
    const std::size_t count = loop.size();
    const int before = loop[(k + count - 1) % count], here = loop[k], after = loop[(k + 1) % count];
    if (flat.turn(before, here, after) == 0) return false;
    return std::any_of(loop.begin(), loop.end(), [&](int other) {
      return other != before && other != here && other != after && flat.turn(before, after, other) != 0;
    });
  };
  // Ears next to the first point make a fan around it, where all corners are strict.
  std::size_t place = 1;
  while (loop.size() > 3) {
    std::size_t tried = 0;
    while (!is_ear(place % loop.size())) {
      ++place;
      if (++tried > loop.size())
        throw std::logic_error("a convex loop of more than three corners has an ear");
    }
    const std::size_t k = place % loop.size(), count = loop.size();
    triangles.push_back({loop[(k + count - 1) % count], loop[k], loop[(k + 1) % count]});
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(k));
    place = k == 0 ? 0 : std::min(k, loop.size() - 1);
  }
  triangles.push_back({loop[0], loop[1], loop[2]});
  return triangles;
}

/// Faces of a surface that lie in one plane on one side, and their outline.
struct FlatGroup {
  std::array<Integer, 4> plane;  ///< outward
  std::vector<std::pair<int, bool>> faces;
  std::vector<int> outline;  ///< counter-clockwise from outside
};

std::vector<FlatGroup> groups_of(const CellComplex& complex, const std::vector<std::pair<int, bool>>& faces) {
  std::map<std::array<Integer, 4>, std::size_t> places;
  std::vector<FlatGroup> groups;
  for (const auto& [index, below] : faces) {
    std::array<Integer, 4> plane = complex.plane(complex.face(index).plane).coefficients();
    if (!below)
      for (Integer& number : plane) number = -number;
    const auto [found, is_new] = places.emplace(plane, groups.size());
    if (is_new) groups.push_back({std::move(plane), {}, {}});
    groups[found->second].faces.emplace_back(index, below);
  }
  return groups;
}

/// @return false if a group has more than one outline, or one that touches itself
bool trace_outline(const CellComplex& complex, FlatGroup& group) {
  std::set<std::pair<int, int>> sides;
  for (const auto& [index, below] : group.faces) {
    const std::vector<int>& points = complex.face(index).points;
    for (std::size_t k = 0; k < points.size(); ++k) {
      std::pair<int, int> side(points[k], points[(k + 1) % points.size()]);
      if (!below) std::swap(side.first, side.second);
      if (sides.erase({side.second, side.first}) == 0) sides.insert(side);
    }
  }
  std::map<int, int> next;
  for (const auto& [from, to] : sides)
    if (!next.emplace(from, to).second) return false;
  int point = next.begin()->first;
  do {
    group.outline.push_back(point);
    point = next.at(point);
  } while (point != group.outline.front());
  return group.outline.size() == next.size();
}

/// Leaves the corners: points in which three groups meet. @return false if an outline has fewer than three
bool drop_straight_points(std::vector<FlatGroup>& groups) {
  std::map<int, int> group_counts;
  for (const FlatGroup& group : groups)
    for (const int point : group.outline) ++group_counts[point];
  for (FlatGroup& group : groups) {
    std::erase_if(group.outline, [&](int point) { return group_counts.at(point) < 3; });
    if (group.outline.size() < 3) return false;
  }
  return true;
}

/// Points by their rounded places, and triangles of them.
class MeshBuilder {
 public:
  int add(int point, const Vector3& place) {
    const auto [found, is_new] = places_.emplace(point, static_cast<int>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(place);
    return found->second;
  }
  void add(const std::array<int, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    if (a != b && b != c && c != a) mesh_.triangles.push_back(triangle);
  }
  [[nodiscard]] TriangleMesh take() { return std::move(mesh_); }

 private:
  TriangleMesh mesh_;
  std::map<int, int> places_;  ///< by point of the complex
};

/// Without points that merge with the one before, and without ways there and back.
std::vector<int> merged_outline(const std::vector<int>& outline, const std::vector<int>& merged) {
  std::vector<int> loop;
  for (const int point : outline) loop.push_back(merged[static_cast<std::size_t>(point)]);
  for (std::size_t k = 0; k < loop.size() && loop.size() >= 3;) {
    const std::size_t next = (k + 1) % loop.size(), after = (k + 2) % loop.size();
    if (loop[k] == loop[next] || loop[k] == loop[after]) {
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(next));
      k = 0;
    } else {
      ++k;
    }
  }
  return loop;
}

TriangleMesh mesh_of_outlines(const CellComplex& complex, const std::vector<FlatGroup>& groups,
                              const std::vector<int>& merged) {
  MeshBuilder builder;
  for (const FlatGroup& group : groups) {
    const std::vector<int> outline = merged_outline(group.outline, merged);
    if (outline.size() < 3) continue;
    std::vector<Vector3> corners;
    for (const int point : outline) corners.push_back(complex.point(point).place.rounded);
    std::vector<int> loop(corners.size());
    std::iota(loop.begin(), loop.end(), 0);
    std::vector<std::array<int, 3>> triangles;
    std::size_t tests_left = std::numeric_limits<std::size_t>::max();
    triangulate_polygon(corners, loop, triangles, tests_left);
    for (auto& triangle : triangles) {
      for (int& corner : triangle) {
        const auto k = static_cast<std::size_t>(corner);
        corner = builder.add(outline[k], corners[k]);
      }
      builder.add(triangle);
    }
  }
  return builder.take();
}

TriangleMesh mesh_of_loops(const CellComplex& complex, const std::vector<std::pair<int, bool>>& faces,
                           const std::vector<int>& merged) {
  MeshBuilder builder;
  for (const auto& [index, below] : faces) {
    const ComplexFace& face = complex.face(index);
    for (auto triangle : triangles_of(complex, face)) {
      for (int& corner : triangle) {
        const int point = merged[static_cast<std::size_t>(face.points[static_cast<std::size_t>(corner)])];
        corner = builder.add(point, complex.point(point).place.rounded);
      }
      if (!below) std::swap(triangle[1], triangle[2]);
      builder.add(triangle);
    }
  }
  return builder.take();
}

}  // namespace

std::vector<std::array<int, 3>> triangles_of_face(const CellComplex& complex, int face) {
  return triangles_of(complex, complex.face(face));
}

std::vector<int> merge_points(const CellComplex& complex, double resolution) {
  const std::size_t count = complex.point_count();
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int point) -> const Vector3& { return complex.point(point).place.rounded; };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::lexicographical_compare(place(a).begin(), place(a).end(), place(b).begin(), place(b).end());
  });
  UnionFind merged(count);
  // Runs of points whose first coordinates follow each other within the resolution, of these runs by the
  // second, and neighbours by the third: points on grids have many equal coordinates.
  for (std::size_t start = 0; start < count;) {
    std::size_t end = start + 1;
    while (end < count && place(order[end])[0] - place(order[end - 1])[0] <= resolution) ++end;
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(start),
              order.begin() + static_cast<std::ptrdiff_t>(end),
              [&](int a, int b) { return place(a)[1] < place(b)[1]; });
    for (std::size_t from = start; from < end;) {
      std::size_t to = from + 1;
      while (to < end && place(order[to])[1] - place(order[to - 1])[1] <= resolution) ++to;
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(from),
                order.begin() + static_cast<std::ptrdiff_t>(to),
                [&](int a, int b) { return place(a)[2] < place(b)[2]; });
      for (std::size_t k = from; k + 1 < to; ++k)
        if (place(order[k + 1])[2] - place(order[k])[2] <= resolution) merged.unite(order[k], order[k + 1]);
      from = to;
    }
    start = end;
  }
  std::vector<int> first(count);
  for (std::size_t k = 0; k < count; ++k) first[k] = merged.find(static_cast<int>(k));
  return first;
}

TriangleMesh mesh_of_faces(const CellComplex& complex, const std::vector<std::pair<int, bool>>& faces,
                           const std::vector<int>& merged) {
  std::vector<FlatGroup> groups = groups_of(complex, faces);
  const bool simple = std::all_of(groups.begin(), groups.end(),
                                  [&](FlatGroup& group) { return trace_outline(complex, group); });
  if (simple && drop_straight_points(groups)) return mesh_of_outlines(complex, groups, merged);
  return mesh_of_loops(complex, faces, merged);
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

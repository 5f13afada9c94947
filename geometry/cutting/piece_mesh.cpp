#include "geometry/cutting/piece_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "geometry/cutting/flat_view.hpp"
#include "geometry/cutting/loop_triangulation.hpp"
#include "geometry/cutting/plane_regions.hpp"
#include "geometry/lexicographic.hpp"
#include "geometry/solid/solid_location.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {
namespace {

double distance_from_segment(const Vector3& x, const Vector3& from, const Vector3& to) {
  const Vector3 along = to - from;
  const double size = along.squaredNorm();
  const double share = size > 0.0 ? std::clamp(along.dot(x - from) / size, 0.0, 1.0) : 0.0;
  return (from + share * along - x).norm();
}

/// Intersection of an edge with a plane, by rounded heights of its ends.
Vector3 crossing(const ExactPlane& plane, const Vector3& from, const Vector3& to) {
  const Vector3 normal = plane.unit_normal();
  const auto& [a, b, c, d] = plane.coefficients();
  const double height = Rational(d, 1).get_d() / Vector3(a.get_d(), b.get_d(), c.get_d()).norm();
  const double low = normal.dot(from) - height, high = normal.dot(to) - height;
  if (low == high) return from;
  return from + std::clamp(low / (low - high), 0.0, 1.0) * (to - from);
}

/// Triangles of a convex loop that may have points in its straight sides. A corner is cut off if that leaves some
/// area and removes some, decided for the exact points. Otherwise a point in the side of two faces could give a
/// sliver in both, one on the other.
std::vector<std::array<int, 3>> triangles_of(const CellComplex& complex, const ComplexFace& face) {
  const FlatView view(complex.plane(face.plane));
  const auto turn = [&](int i, int j, int k) {
    const auto at = [&](int n) -> const ExactPoint& {
      return complex.point(face.points[static_cast<std::size_t>(n)]).place;
    };
    return view.turn(at(i), at(j), at(k));
  };
  std::vector<int> loop(face.points.size());
  std::iota(loop.begin(), loop.end(), 0);
  std::vector<std::array<int, 3>> triangles;
  const auto is_ear = [&](std::size_t k) {
    const std::size_t count = loop.size();
    const int before = loop[(k + count - 1) % count], here = loop[k], after = loop[(k + 1) % count];
    if (turn(before, here, after) == 0) return false;
    return std::any_of(loop.begin(), loop.end(), [&](int other) {
      return other != before && other != here && other != after && turn(before, after, other) != 0;
    });
  };
  // Ears next to the first point form a fan around it if all corners are strict.
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

/// Faces of a surface in one plane on one side, and the outlines of their connected parts, as seen from outside.
struct FlatGroup {
  std::array<Integer, 4> plane;  ///< outward
  std::vector<std::pair<int, bool>> faces;
  std::vector<std::vector<std::vector<int>>> regions;  ///< loops, the outer one first
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

/// Sides of faces without those between two of them.
std::vector<OutlineSide> outer_sides(const CellComplex& complex, const FlatGroup& group) {
  std::set<std::pair<int, int>> sides;
  for (const auto& [index, below] : group.faces) {
    for (const OutlineSide& of : sides_of(complex.face(index))) {
      const std::pair<int, int> side = below ? std::pair(of.from, of.to) : std::pair(of.to, of.from);
      if (sides.erase({side.second, side.first}) == 0) sides.insert(side);
    }
  }
  std::vector<OutlineSide> result;
  result.reserve(sides.size());
  for (const auto& [from, to] : sides) result.push_back({from, to, -1});
  return result;
}

void trace_outlines(const CellComplex& complex, FlatGroup& group) {
  const auto& [a, b, c, d] = group.plane;
  const ExactPlane plane({Rational(a), Rational(b), Rational(c)}, Rational(d));
  for (const FaceOutline& outline : plane_regions(complex, plane, outer_sides(complex, group))) {
    std::vector<std::vector<int>> loops;
    for (const std::span<const int> loop : loops_of(outline)) loops.emplace_back(loop.begin(), loop.end());
    group.regions.push_back(std::move(loops));
  }
}

/// Keeps corners only: points in which three groups meet, or a group meets itself. @return false if a loop has fewer
/// than three
bool drop_straight_points(std::vector<FlatGroup>& groups) {
  std::map<int, int> group_counts;
  std::set<int> met;
  const auto for_each_loop = [&](auto visit) {
    for (FlatGroup& group : groups)
      for (auto& region : group.regions) std::for_each(region.begin(), region.end(), visit);
  };
  for (FlatGroup& group : groups) {
    std::set<int> points;
    for (const auto& region : group.regions)
      for (const auto& loop : region)
        for (const int point : loop)
          if (!points.insert(point).second) met.insert(point);
    for (const int point : points) ++group_counts[point];
  }
  bool good = true;
  for_each_loop([&](std::vector<int>& loop) {
    std::erase_if(loop, [&](int point) { return group_counts.at(point) < 3 && !met.contains(point); });
    good = good && loop.size() >= 3;
  });
  return good;
}

/// Builds a mesh from triangles of points of a complex.
class MeshBuilder {
 public:
  explicit MeshBuilder(const CellComplex& complex) : complex_(complex) {}
  void add(const std::vector<std::array<int, 3>>& triangles) {
    for (auto triangle : triangles) {
      for (int& corner : triangle) corner = place_of(corner);
      const auto& [a, b, c] = triangle;
      if (a != b && b != c && c != a) mesh_.triangles.push_back(triangle);
    }
  }
  [[nodiscard]] TriangleMesh take() { return std::move(mesh_); }

 private:
  int place_of(int point) {
    const auto [found, is_new] = places_.emplace(point, static_cast<int>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(complex_.point(point).place.rounded);
    return found->second;
  }

  const CellComplex& complex_;
  TriangleMesh mesh_;
  std::map<int, int> places_;  ///< by point of the complex
};

Vector3 outward_normal(const CellComplex& complex, const std::pair<int, bool>& face) {
  const Vector3 normal = complex.plane(complex.face(face.first).plane).unit_normal();
  return face.second ? normal : Vector3(Vector3::Zero() - normal);
}

/// Removes points merged with the preceding one, and segments traversed in both directions.
std::vector<int> merged_outline(const std::vector<int>& outline, const std::vector<int>& merged) {
  std::vector<int> loop;
  loop.reserve(outline.size());
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

using Triangles = std::vector<std::array<int, 3>>;

/// @return triangles of points of the complex. @param normal about which the loops are counter-clockwise
Triangles triangles_of_loops(const CellComplex& complex, const std::vector<std::vector<int>>& loops,
                             const Vector3& normal) {
  std::vector<Vector3> corners;
  std::vector<int> points;
  std::vector<std::vector<int>> numbered;
  for (const std::vector<int>& loop : loops) {
    numbered.emplace_back();
    for (const int point : loop) {
      numbered.back().push_back(static_cast<int>(points.size()));
      points.push_back(point);
      corners.push_back(complex.point(point).place.rounded);
    }
  }
  Triangles triangles = triangulate_loops(corners, numbered, normal);
  for (auto& triangle : triangles)
    for (int& corner : triangle) corner = points[static_cast<std::size_t>(corner)];
  return triangles;
}

TriangleMesh mesh_of_outlines(const CellComplex& complex, const std::vector<FlatGroup>& groups,
                              const std::vector<int>& merged) {
  MeshBuilder builder(complex);
  for (const FlatGroup& group : groups) {
    const Vector3 normal = outward_normal(complex, group.faces.front());
    for (const auto& region : group.regions) {
      std::vector<std::vector<int>> loops;
      for (const std::vector<int>& outline : region) {
        std::vector<int> loop = merged_outline(outline, merged);
        if (loop.size() >= 3)
          loops.push_back(std::move(loop));
        else if (loops.empty())
          break;
      }
      if (!loops.empty()) builder.add(triangles_of_loops(complex, loops, normal));
    }
  }
  return builder.take();
}

/// Triangles of points of the complex, counter-clockwise as seen from above.
Triangles triangles_of_any(const CellComplex& complex, int index) {
  const ComplexFace& face = complex.face(index);
  if (!face.convex) {
    std::vector<std::vector<int>> loops;
    for (const std::span<const int> loop : loops_of(face)) loops.emplace_back(loop.begin(), loop.end());
    return triangles_of_loops(complex, loops, complex.plane(face.plane).unit_normal());
  }
  Triangles triangles = triangles_of(complex, face);
  for (auto& triangle : triangles)
    for (int& corner : triangle) corner = face.points[static_cast<std::size_t>(corner)];
  return triangles;
}

TriangleMesh mesh_of_loops(const CellComplex& complex, const std::vector<std::pair<int, bool>>& faces,
                           const std::vector<int>& merged) {
  MeshBuilder builder(complex);
  for (const auto& [index, below] : faces) {
    Triangles triangles = triangles_of_any(complex, index);
    for (auto& triangle : triangles) {
      for (int& corner : triangle) corner = merged[static_cast<std::size_t>(corner)];
      if (!below) std::swap(triangle[1], triangle[2]);
    }
    builder.add(triangles);
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
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return lexicographically_less(place(a), place(b)); });
  UnionFind merged(count);
  // Runs of points whose first coordinates are consecutive within the resolution, of these runs by the second, and
  // neighbours by the third: points on grids have many equal coordinates.
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
  for (FlatGroup& group : groups) trace_outlines(complex, group);
  if (drop_straight_points(groups)) return mesh_of_outlines(complex, groups, merged);
  return mesh_of_loops(complex, faces, merged);
}

double distance_from_section(const CellComplex& complex, int cell, const ExactPlane& plane,
                             const ExactPoint& from) {
  double nearest = std::numeric_limits<double>::infinity();
  bool above = false, below = false;
  MeshBuilder surface(complex);
  for (const int index : complex.faces(cell)) {
    Triangles triangles = triangles_of_any(complex, index);
    for (const auto& corners : triangles) {
      std::vector<Vector3> ends;
      for (std::size_t k = 0; k < 3; ++k) {
        const ExactPoint& a = complex.point(corners[k]).place;
        const ExactPoint& b = complex.point(corners[(k + 1) % 3]).place;
        const int of_a = plane.side(a), of_b = plane.side(b);
        above = above || of_a > 0;
        below = below || of_a < 0;
        if (of_a == 0) ends.push_back(a.rounded);
        if (of_a * of_b < 0) ends.push_back(crossing(plane, a.rounded, b.rounded));
      }
      for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        nearest = std::min(nearest, distance_from_segment(from.rounded, ends[k], ends[k + 1]));
    }
    if (complex.face(index).cells[0] != cell)
      for (auto& triangle : triangles) std::swap(triangle[1], triangle[2]);
    surface.add(triangles);
  }
  if (!above || !below) return std::numeric_limits<double>::infinity();
  return nearest == 0.0 || is_inside(surface.take(), from.rounded) ? 0.0 : nearest;
}

}  // namespace ashlar

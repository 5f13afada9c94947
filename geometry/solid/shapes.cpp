#include "geometry/solid/shapes.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "geometry/exact/rounding_mode.hpp"
#include "geometry/mesh/polygon_triangulation.hpp"
#include "geometry/solid/hull_surface.hpp"

namespace ashlar {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using HullMesh = CGAL::Surface_mesh<Kernel::Point_3>;

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument(message);
}

bool are_coplanar(const std::vector<Kernel::Point_3>& points) {
  const auto& a = points.front();
  const auto b = std::find_if(points.begin(), points.end(), [&](const auto& p) { return p != a; });
  if (b == points.end()) return true;
  const auto c = std::find_if(b, points.end(), [&](const auto& p) { return !CGAL::collinear(a, *b, p); });
  return c == points.end() ||
         std::all_of(c, points.end(), [&](const auto& p) { return CGAL::coplanar(a, *b, *c, p); });
}

TriangleMesh to_triangle_mesh(const HullMesh& hull) {
  TriangleMesh mesh;
  for (const auto v : hull.vertices()) {
    const Kernel::Point_3& p = hull.point(v);
    mesh.points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : hull.faces()) {
    auto& triangle = mesh.triangles.emplace_back();
    int corner = 0;
    for (const auto v : hull.vertices_around_face(hull.halfedge(f)))
      triangle.at(corner++) = static_cast<int>(v);
  }
  return mesh;
}

TriangleMesh make_icosahedron() {
  constexpr double g = std::numbers::phi;
  TriangleMesh mesh;
  mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Vector3& p : mesh.points) p.normalize();
  return mesh;
}

// Splits every triangle into four and projects the new points to the unit sphere.
TriangleMesh split_on_unit_sphere(TriangleMesh coarse) {
  TriangleMesh fine;
  fine.points = std::move(coarse.points);
  std::unordered_map<std::uint64_t, int> middle_of_edge;
  const auto middle = [&](int i, int j) {
    const auto [low, high] = std::minmax(i, j);
    const auto key = (static_cast<std::uint64_t>(low) << 32U) | static_cast<std::uint64_t>(high);
    const auto [place, is_new] = middle_of_edge.try_emplace(key, static_cast<int>(fine.points.size()));
    if (is_new) {
      const Vector3 sum = fine.points[i] + fine.points[j];
      fine.points.push_back(sum.normalized());
    }
    return place->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const int ab = middle(a, b);
    const int bc = middle(b, c);
    const int ca = middle(c, a);
    fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return fine;
}

/// The facets of a hull as fans from their first corner, with corners in the order of the input points: in the
/// library, the edges that divide a facet and the numbers of points and triangles depend on memory addresses.
TriangleMesh fans_of_facets(std::span<const Vector3> input, const TriangleMesh& hull) {
  std::map<std::array<double, 3>, std::size_t> place_in_input;
  for (std::size_t k = 0; k < input.size(); ++k)
    place_in_input.try_emplace({input[k].x(), input[k].y(), input[k].z()}, k);
  std::vector<int> point_of_input(input.size(), -1);
  for (std::size_t v = 0; v < hull.points.size(); ++v) {
    const Vector3& x = hull.points[v];
    point_of_input[place_in_input.at({x.x(), x.y(), x.z()})] = static_cast<int>(v);
  }
  NumericRange range;
  for (const Vector3& p : hull.points)
    for (int i = 0; i < 3; ++i) range.include(p[i]);
  const HullSurface surface(hull.points, hull.triangles, range.safe());
  TriangleMesh result;
  std::vector<int> corner_of_point(hull.points.size(), -1);
  for (std::size_t k = 0; k < input.size(); ++k) {
    const int v = point_of_input[k];
    if (v < 0 || surface.group_counts()[v] < 3) continue;
    corner_of_point[v] = static_cast<int>(result.points.size());
    result.points.push_back(input[k]);
  }
  FacetBoundaries boundaries(surface);
  for (int t = 0; t < static_cast<int>(hull.triangles.size()); ++t) {
    if (surface.group(t) != t) continue;
    std::vector<int> loop = boundaries.loop(t);
    for (int& v : loop) v = corner_of_point[v];
    append_fan(std::move(loop), result.triangles);
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

[[gnu::noinline]] TriangleMesh make_hull_to_nearest(std::span<const Vector3> points) {
  std::vector<Kernel::Point_3> input;
  input.reserve(points.size());
  for (const Vector3& p : points) {
    require(p.allFinite(), "hull points must be finite");
    input.emplace_back(p.x(), p.y(), p.z());
  }
  require(!are_coplanar(input), "hull of coplanar points has no volume");
  HullMesh hull;
  CGAL::convex_hull_3(input.begin(), input.end(), hull);
  return fans_of_facets(points, to_triangle_mesh(hull));
}

}  // namespace

TriangleMesh make_box(const Vector3& low, const Vector3& high) {
  require(low.allFinite() && high.allFinite(), "box corners must be finite");
  for (int d = 0; d < 3; ++d) {
    require(low[d] < high[d], std::string("box ") + "xyz"[d] + " from " + std::to_string(low[d]) + " to " +
                                  std::to_string(high[d]) + ", must increase");
  }
  TriangleMesh mesh;
  mesh.points.reserve(8);
  for (unsigned i = 0; i < 8; ++i) {
    mesh.points.emplace_back((i & 1U) != 0 ? high.x() : low.x(), (i & 2U) != 0 ? high.y() : low.y(),
                             (i & 4U) != 0 ? high.z() : low.z());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh make_convex_hull(std::span<const Vector3> points) {
  require(points.size() >= 4, "hull of " + std::to_string(points.size()) + " points, needs at least 4");
  const NearestRounding nearest;
  return make_hull_to_nearest(points);
}

TriangleMesh make_sphere(const Vector3& center, double radius, int subdivisions) {
  require(center.allFinite(), "sphere center must be finite");
  require(std::isfinite(radius) && radius > 0.0,
          "sphere radius (" + std::to_string(radius) + "), must be positive and finite");
  require(subdivisions >= 0 && subdivisions <= 7,
          "sphere subdivisions (" + std::to_string(subdivisions) + "), allowed 0 to 7");
  TriangleMesh mesh = make_icosahedron();
  for (int i = 0; i < subdivisions; ++i) mesh = split_on_unit_sphere(std::move(mesh));
  for (Vector3& p : mesh.points) p = center + radius * p;
  return mesh;
}

}  // namespace ashlar

#include "apps/scene/meshes/open_terrain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

namespace ashlar {
namespace {

using Edge = std::pair<int, int>;

const Vector3& corner(const TriangleMesh& mesh, int index) {
  return mesh.points[static_cast<std::size_t>(index)];
}

/// Twice the signed area of the projection to a level plane, m^2.
double level_area(const TriangleMesh& mesh, const std::array<int, 3>& triangle) {
  const Vector3 &a = corner(mesh, triangle[0]), &b = corner(mesh, triangle[1]),
                &c = corner(mesh, triangle[2]);
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

void turn_upward(TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& triangle : mesh.triangles) sum += level_area(mesh, triangle);
  if (sum >= 0.0) return;
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

void require_upward(const TriangleMesh& mesh) {
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    if (!(level_area(mesh, mesh.triangles[k]) > 0.0))
      throw std::invalid_argument(fmt::format(
          "triangle {} is upright or overhangs, a surface with one height at each place is needed", k + 1));
}

/// Edges with a triangle on one side, in its direction.
std::vector<Edge> rim_of(const TriangleMesh& mesh) {
  std::map<Edge, int> uses;
  for (const auto& [a, b, c] : mesh.triangles)
    for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) ++uses[edge];
  std::vector<Edge> rim;
  for (const auto& [edge, count] : uses) {
    if (count > 1)
      throw std::invalid_argument(fmt::format(
          "edge between points {} and {} has several triangles on one side, one surface is needed",
          edge.first + 1, edge.second + 1));
    if (!uses.contains({edge.second, edge.first})) rim.push_back(edge);
  }
  return rim;
}

}  // namespace

void close_terrain_below(TriangleMesh& mesh, double bottom) {
  turn_upward(mesh);
  require_upward(mesh);
  const std::vector<Edge> rim = rim_of(mesh);
  if (rim.empty()) throw std::invalid_argument("surface has no rim, an open one is needed");
  const auto lowest = std::min_element(mesh.points.begin(), mesh.points.end(),
                                       [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  if (!(lowest->z() > bottom))
    throw std::invalid_argument(fmt::format(
        "surface reaches down to z = {:g}, close_below ({:g}) must be lower", lowest->z(), bottom));
  const int count = static_cast<int>(mesh.points.size());
  const std::size_t surface = mesh.triangles.size();
  for (int k = 0; k < count; ++k) {
    const Vector3 point = corner(mesh, k);
    mesh.points.emplace_back(point.x(), point.y(), bottom);
  }
  for (std::size_t k = 0; k < surface; ++k) {
    const auto [a, b, c] = mesh.triangles[k];
    mesh.triangles.push_back({a + count, c + count, b + count});
  }
  for (const auto& [a, b] : rim) {
    mesh.triangles.push_back({b, a, a + count});
    mesh.triangles.push_back({b, a + count, b + count});
  }
}

}  // namespace ashlar

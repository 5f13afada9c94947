#include "geometry/mesh/mesh_repair.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {
namespace {

// Largest weld distance relative to the extent: beyond it welding would change the shape.
constexpr double largest_weld = 0.1;
// Smallest weld distance relative to the largest coordinate: the spacing of doubles there is coarser.
constexpr double smallest_weld = 0x1p-50;

// Most triangles at an edge shared by several bodies: more are a defect, and would need quadratic time.
constexpr std::size_t most_sides = 1000;

/// Points in cubes of the side `distance`. Kept points are apart by more than that, so that a cube has few.
class PointGrid {
 public:
  PointGrid(const std::vector<Vector3>& points, double distance) : points_(points), distance_(distance) {}

  /// The nearest kept point within the distance, or -1.
  [[nodiscard]] int near(const Vector3& point) const {
    const Cell cell = cell_of(point);
    int nearest = -1;
    double least = distance_ * distance_;
    for (int corner = 0; corner < 27; ++corner) {
      const Cell other = {cell[0] + corner % 3 - 1, cell[1] + corner / 3 % 3 - 1, cell[2] + corner / 9 - 1};
      const auto found = cells_.find(other);
      if (found == cells_.end()) continue;
      for (const int kept : found->second) {
        const double squared = (points_[static_cast<std::size_t>(kept)] - point).squaredNorm();
        if (squared > least || (squared == least && nearest >= 0)) continue;
        least = squared;
        nearest = kept;
      }
    }
    return nearest;
  }

  void keep(int index) { cells_[cell_of(points_[static_cast<std::size_t>(index)])].push_back(index); }

 private:
  // Whole numbers, as doubles because they may exceed integers.
  using Cell = std::array<double, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const {
      std::size_t hash = 0;
      for (const double index : cell) hash = hash * 1000003U ^ std::hash<double>()(index);
      return hash;
    }
  };

  [[nodiscard]] Cell cell_of(const Vector3& point) const {
    return {std::floor(point.x() / distance_), std::floor(point.y() / distance_),
            std::floor(point.z() / distance_)};
  }

  const std::vector<Vector3>& points_;
  double distance_;
  std::unordered_map<Cell, std::vector<int>, CellHash> cells_;
};

void check_distance(const TriangleMesh& mesh, double distance) {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vector3& point : mesh.points) {
    if (!point.allFinite()) throw std::invalid_argument("a coordinate is not finite, numbers are needed");
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  if (mesh.points.empty()) return;
  const double extent = (high - low).maxCoeff(),
               largest = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  if (distance <= largest_weld * extent && distance >= smallest_weld * largest) return;
  std::ostringstream text;
  text << "weld is " << distance << " in units of the file, " << smallest_weld * largest << " to "
       << largest_weld * extent << " is allowed";
  throw std::invalid_argument(text.str());
}

/// The triangles with their points, in the order of the mesh.
TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<int>& triangles) {
  TriangleMesh part;
  std::vector<int> used;
  for (const int t : triangles)
    for (const int point : mesh.triangles[static_cast<std::size_t>(t)]) used.push_back(point);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const int point : used) part.points.push_back(mesh.points[static_cast<std::size_t>(point)]);
  const auto place = [&](int point) {
    return static_cast<int>(std::lower_bound(used.begin(), used.end(), point) - used.begin());
  };
  for (const int t : triangles) {
    const auto& corners = mesh.triangles[static_cast<std::size_t>(t)];
    part.triangles.push_back({place(corners[0]), place(corners[1]), place(corners[2])});
  }
  return part;
}

/// One side of an edge: its triangle, its direction (true: from the smaller point to the larger), and the third
/// corner.
struct EdgeSide {
  int triangle;
  bool forward;
  int apex;
};

using SidesByEdge = std::map<std::pair<int, int>, std::vector<EdgeSide>>;

SidesByEdge sides_of_edges(const TriangleMesh& mesh) {
  SidesByEdge edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3],
                c = mesh.triangles[t][(k + 2) % 3];
      edges[std::minmax(a, b)].push_back({static_cast<int>(t), a < b, c});
    }
  return edges;
}

/// Unites the triangles around an edge shared by more than two. Seen along the edge, the inside is on one rotational
/// side of a forward triangle, on the other one of a backward triangle. Neighbours are a forward one and the first
/// backward one met by rotation through the inside.
/// @param coincident rad: there is no inside between faces of touching bodies that coincide within this angle
void unite_around(const TriangleMesh& mesh, const std::pair<int, int>& edge,
                  const std::vector<EdgeSide>& sides, double coincident, UnionFind& sets) {
  const Vector3 from = mesh.points[static_cast<std::size_t>(edge.first)];
  const Vector3 axis = (mesh.points[static_cast<std::size_t>(edge.second)] - from).stableNormalized();
  const Vector3 x = axis.unitOrthogonal(), y = axis.cross(x);
  const auto angle_of = [&](const EdgeSide& side) {
    const Vector3 arm = mesh.points[static_cast<std::size_t>(side.apex)] - from;
    return correctly_rounded::atan2(arm.dot(y), arm.dot(x));
  };
  std::vector<bool> used(sides.size(), false);
  for (const EdgeSide& forward : sides) {
    if (!forward.forward) continue;
    // The outward normal of a forward triangle is axis x arm, a quarter turn on: the inside is behind it.
    const double start = angle_of(forward);
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = sides.size();
    for (std::size_t k = 0; k < sides.size(); ++k) {
      if (sides[k].forward || used[k]) continue;
      double turn = start - angle_of(sides[k]);
      while (turn <= coincident) turn += 2.0 * std::numbers::pi;
      while (turn > 2.0 * std::numbers::pi + coincident) turn -= 2.0 * std::numbers::pi;
      if (turn >= least) continue;
      least = turn;
      nearest = k;
    }
    if (nearest == sides.size()) continue;
    used[nearest] = true;
    sets.unite(forward.triangle, sides[nearest].triangle);
  }
}

}  // namespace

WeldCount weld_corners(TriangleMesh& mesh, double distance) {
  check_distance(mesh, distance);
  WeldCount count;
  PointGrid grid(mesh.points, distance);
  std::vector<int> becomes(mesh.points.size());
  for (std::size_t k = 0; k < mesh.points.size(); ++k) {
    const int near = grid.near(mesh.points[k]);
    becomes[k] = near >= 0 ? near : static_cast<int>(k);
    if (near >= 0)
      ++count.corners;
    else
      grid.keep(static_cast<int>(k));
  }
  std::vector<int> left;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto& corners = mesh.triangles[t];
    for (int& corner : corners) corner = becomes[static_cast<std::size_t>(corner)];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
      ++count.triangles;
    else
      left.push_back(static_cast<int>(t));
  }
  mesh = part_of(mesh, left);
  return count;
}

std::vector<TriangleMesh> closed_components(const TriangleMesh& mesh, double coincident) {
  UnionFind sets(mesh.triangles.size());
  for (const auto& [edge, sides] : sides_of_edges(mesh)) {
    if (sides.size() == 2)
      sets.unite(sides[0].triangle, sides[1].triangle);
    else if (sides.size() > 2 && sides.size() <= most_sides)
      unite_around(mesh, edge, sides, coincident, sets);
  }
  // A root is the first of its set, so that this is the order of first triangles.
  std::map<int, std::vector<int>> triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    triangles[sets.find(static_cast<int>(t))].push_back(static_cast<int>(t));
  std::vector<TriangleMesh> components;
  for (const auto& [root, members] : triangles) components.push_back(part_of(mesh, members));
  return components;
}

double rounded_volume(const TriangleMesh& mesh) {
  if (mesh.points.empty()) return 0.0;
  const Vector3 about = mesh.points.front();
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto arm = [&](int k) -> Vector3 { return mesh.points[static_cast<std::size_t>(k)] - about; };
    volume += arm(a).dot(arm(b).cross(arm(c))) / 6.0;
  }
  return volume;
}

void turn_inside_out(TriangleMesh& mesh) {
  for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
}

}  // namespace ashlar

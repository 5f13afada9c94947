#include "geometry/subfaces/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "geometry/boxes/box_tree.hpp"

namespace ashlar {
namespace {

double largest_coordinate(const Box& box) {
  return std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
}

double rounding_of_slabs(const PlacedSurface& a, const PlacedSurface& b) {
  return 32.0 * std::numeric_limits<double>::epsilon() *
         std::max(largest_coordinate(a.box()), largest_coordinate(b.box()));
}

double distance_of(const Box& a, const Box& b) {
  return std::sqrt(squared_distance(a, b));
}

/// Width of the slab across a direction between two sets of points, negative if the direction does not separate them.
double slab_between(std::span<const Vector3> a, std::span<const Vector3> b, const Vector3& direction) {
  const auto extreme = [&](std::span<const Vector3> points, double sign) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector3& point : points) most = std::max(most, sign * direction.dot(point));
    return most;
  };
  return -extreme(b, -1.0) - extreme(a, 1.0);
}

/// Of few cells: the widest slab between the whole surfaces across an axis, the line between the middles or a face.
double distance_by_slabs(const PlacedSurface& a, const PlacedSurface& b) {
  const double off = a.largest_chord_bound() + b.largest_chord_bound() + rounding_of_slabs(a, b);
  double bound = distance_of(a.box(), b.box());
  const auto try_direction = [&](const Vector3& direction) {
    bound = std::max(bound, slab_between(a.points(), b.points(), direction) - off);
  };
  const Vector3 between = 0.5 * (b.box().low + b.box().high - a.box().low - a.box().high);
  if (between.norm() > 0.0) try_direction(between.normalized());
  for (int cell = 0; cell < static_cast<int>(a.surface().cells.size()); ++cell) try_direction(a.normal(cell));
  for (int cell = 0; cell < static_cast<int>(b.surface().cells.size()); ++cell)
    try_direction(-b.normal(cell));
  return bound;
}

/// The widest slab between two sets of points across directions that Gilbert's iteration tries, SIAM J. Control 4 (1966) 61:
/// towards the point of their difference that is nearest to the origin. 0: none was found
double slab_of_gilbert(std::span<const Vector3> a, std::span<const Vector3> b) {
  constexpr int most = 32;
  constexpr double enough = 0.9;  // of the distance
  const auto farthest = [](std::span<const Vector3> points, const Vector3& direction) {
    return *std::max_element(points.begin(), points.end(), [&](const Vector3& x, const Vector3& y) {
      return direction.dot(x) < direction.dot(y);
    });
  };
  Vector3 nearest = b.front() - a.front();
  double width = 0.0;
  for (int k = 0; k < most; ++k) {
    const double distance = nearest.norm();
    if (!(distance > 0.0)) break;
    const Vector3 support = farthest(b, -nearest) - farthest(a, nearest);
    width = std::max(width, nearest.dot(support) / distance);
    const Vector3 offset = support - nearest;
    if (width >= enough * distance || !(offset.squaredNorm() > 0.0)) break;
    nearest += std::clamp(-nearest.dot(offset) / offset.squaredNorm(), 0.0, 1.0) * offset;
  }
  return width;
}

/// Of two cells: by their boxes and by slabs across their planes and other directions.
double distance_of_cells(const PlacedSurface& a, int cell_a, const PlacedSurface& b, int cell_b,
                         double rounding) {
  const std::vector<Vector3> corners_a = a.corners(cell_a), corners_b = b.corners(cell_b);
  double width = slab_of_gilbert(corners_a, corners_b);
  for (const Vector3& normal : {a.normal(cell_a), b.normal(cell_b)})
    width = std::max(
        {width, slab_between(corners_a, corners_b, normal), slab_between(corners_a, corners_b, -normal)});
  return std::max(distance_of(a.cell_box(cell_a), b.cell_box(cell_b)),
                  width - a.chord_bound(cell_a) - b.chord_bound(cell_b) - rounding);
}

/// Of many cells: the least of those that are near each other, at most half of the size of the smaller surface.
double distance_by_cells(const PlacedSurface& a, const PlacedSurface& b) {
  const double apart = distance_of(a.box(), b.box());
  const double rounding = rounding_of_slabs(a, b);
  double bound = apart + 0.5 * std::min(a.size(), b.size());
  const auto tree_of = [](const PlacedSurface& surface, std::optional<BoxTree>& own) -> const BoxTree& {
    if (surface.has_many_cells()) return surface.cell_tree();
    std::vector<Box> boxes;
    boxes.reserve(surface.surface().cells.size());
    for (int cell = 0; cell < static_cast<int>(surface.surface().cells.size()); ++cell)
      boxes.push_back(surface.cell_box(cell));
    return own.emplace(std::move(boxes));
  };
  std::optional<BoxTree> of_a, of_b;
  for_each_near_pair(
      tree_of(a, of_a), tree_of(b, of_b), [&] { return bound * bound; },
      [&](int cell_a, int cell_b) {
        bound = std::min(bound, distance_of_cells(a, cell_a, b, cell_b, rounding));
        return bound > apart;
      });
  return std::max(bound, apart);
}

}  // namespace

double least_distance(const PlacedSurface& a, const PlacedSurface& b) {
  return a.has_many_cells() || b.has_many_cells() ? distance_by_cells(a, b) : distance_by_slabs(a, b);
}

}  // namespace ashlar

// Boxes with sides along the axes, of space or of a frame.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// A closed box; initially empty, without intersections.
struct Box {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = Vector3::Constant(-std::numeric_limits<double>::infinity());

  [[nodiscard]] bool meets(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  [[nodiscard]] bool is_empty() const { return !(low.array() <= high.array()).all(); }
  [[nodiscard]] bool contains(const Vector3& point) const {
    return (low.array() <= point.array()).all() && (point.array() <= high.array()).all();
  }
  void include(const Vector3& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  void include(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  /// @param margin m, >= 0
  [[nodiscard]] Box grown(double margin) const {
    return {low - Vector3::Constant(margin), high + Vector3::Constant(margin)};
  }
};

/// The part of a segment within a box, rounded. @return shares of the segment, 0 to 1 in order; empty: no
/// intersection
[[nodiscard]] inline std::optional<std::array<double, 2>> part_within(const Box& box, const Vector3& start,
                                                                      const Vector3& end) {
  double first = 0.0, last = 1.0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double rise = end[k] - start[k];
    double enter = box.low[k] - start[k], leave = box.high[k] - start[k];
    if (rise == 0.0) {
      if (enter > 0.0 || leave < 0.0) return std::nullopt;
      continue;
    }
    enter /= rise;
    leave /= rise;
    if (enter > leave) std::swap(enter, leave);
    first = std::max(first, enter);
    last = std::min(last, leave);
  }
  if (first > last) return std::nullopt;
  return std::array{first, last};
}

[[nodiscard]] inline Box box_of(std::span<const Vector3> points) {
  Box box;
  for (const Vector3& point : points) box.include(point);
  return box;
}

/// The box along other axes, in their coordinates; contains the convex hull of the points in spite of rounding.
/// @param axes (3, 3), orthonormal columns
[[nodiscard]] inline Box box_along(const Eigen::Matrix3d& axes, std::span<const Vector3> points) {
  Box box;
  double farthest = 0.0;
  for (const Vector3& point : points) {
    box.include(Vector3(axes.transpose() * point));
    farthest = std::max(farthest, point.cwiseAbs().maxCoeff());
  }
  return points.empty() ? box : box.grown(8.0 * std::numeric_limits<double>::epsilon() * farthest);
}

}  // namespace ashlar

// The level of water in the ground or in front of a wall, and its hydrostatic pressure.
//
//   p(X) = unit_weight d(X),   d(X) = height of the level above X, along `up`;   0 above the level
// A level that is inclined is piezometric: pressure at a place is that of a column of water up to it, so that a level
// that falls from the crest to the toe gives a pressure that falls linearly along a joint (Hoek and Bray, Rock Slope
// Engineering, chapter 7; dams: uplift).
#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "geometry/terrain/height_field.hpp"
#include "mechanics/supports/face_selection.hpp"
#include "mechanics/supports/linear_patch.hpp"

namespace ashlar {

class WaterLevel {
 public:
  /// @param level plane of the surface. @param up unit vector against gravity
  /// @throws std::invalid_argument if the plane is parallel to `up`, or its normal zero
  WaterLevel(const Plane& level, const Vector3& up);
  /// Up is z. The level is known in the convex hull of the points in plan.
  explicit WaterLevel(HeightField level);

  /// Height of the level over a point, m, negative above the level; empty where it is not known.
  [[nodiscard]] std::optional<double> depth(const Vector3& point) const;
  /// The parts of a convex polygon below the level, with their depth (m, >= 0). Parts do not overlap.
  /// @param polygon (#corners >= 3), in a plane of any direction
  /// @return empty where the level is known at no corner
  [[nodiscard]] std::vector<LinearPatch> below(const std::vector<Vector3>& polygon) const;

 private:
  struct Inclined {
    Vector3 origin;    ///< a point of the level
    Vector3 gradient;  ///< of the depth
  };
  [[nodiscard]] Inclined triangle(std::size_t index) const;
  /// Signed areas of a place against the sides of a triangle in plan, relative to the triangle's.
  [[nodiscard]] std::array<double, 3> shares(std::size_t index, const Vector3& point) const;
  /// True if another triangle has this side. @param side 0 to 2: from this corner to the next
  [[nodiscard]] bool has_neighbour(std::size_t index, std::size_t side) const;
  /// True if the box of a triangle in plan does not meet that of a polygon.
  [[nodiscard]] bool misses(std::size_t index, const std::vector<Vector3>& polygon) const;
  static void add_below(const Inclined& level, std::vector<Vector3> polygon, std::vector<LinearPatch>& parts);

  std::variant<Inclined, HeightField> level_;
};

}  // namespace ashlar

// A plane normal to a direction of projection.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Place (s, t) stands for the line origin + s e1 + t e2 + any multiple of w.
struct ViewFrame {
  Vector3 origin = Vector3::Zero();
  Vector3 e1 = Vector3::UnitX();
  Vector3 e2 = Vector3::UnitY();
  Vector3 w = Vector3::UnitZ();  ///< unit; e1, e2, w is a right-handed orthonormal frame

  /// The axes of coordinates, seen against z.
  ViewFrame() = default;
  /// @param direction not zero, any length
  ViewFrame(const Vector3& origin, const Vector3& direction);
  [[nodiscard]] Eigen::Vector2d project(const Vector3& point) const;
};

}  // namespace ashlar

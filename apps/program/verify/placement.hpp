// Verification scenes rotated and translated as a whole: results must transform likewise.
#pragma once

#include "solver/run/simulation.hpp"

namespace ashlar {

/// Placement of a scene: x -> turn x + shift for places, turn v for directions.
struct Placement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< a rotation
  Vector3 shift = Vector3::Zero();                     ///< m

  [[nodiscard]] Vector3 point(const Vector3& x) const { return turn * x + shift; }
  [[nodiscard]] Vector3 direction(const Vector3& v) const { return turn * v; }
  /// The inverse of point(): places of a placed scene in the scene's own axes.
  [[nodiscard]] Vector3 point_back(const Vector3& x) const { return turn.transpose() * (x - shift); }
  /// The inverse of direction().
  [[nodiscard]] Vector3 direction_back(const Vector3& v) const { return turn.transpose() * v; }
};

/// A general placement: rotation of 0.8 rad about (1, 2, 3), translation by (12, -30, 5).
[[nodiscard]] Placement some_placement();

/// Rotates and translates material points: x -> turn x + shift, with the same faces.
[[nodiscard]] Polyhedron placed(const Polyhedron& solid, const Placement& placement);

/// A block with its shape, supports, loads and points, rotated and translated as a whole.
/// @throws std::invalid_argument if the placement has a rotation and a support fixes some components only: these are
/// along the axes of space, and the rotated support would fix another direction
[[nodiscard]] BlockDefinition placed(BlockDefinition block, const Placement& placement);

/// Rotates velocities.
[[nodiscard]] InitialMotion placed(const InitialMotion& motion, const Placement& placement);

}  // namespace ashlar

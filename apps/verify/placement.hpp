// Scenes of verification cases turned and moved as a whole: results must turn and move with them.
#pragma once

#include "solver/run/simulation.hpp"

namespace ashlar {

/// Where a scene is: x -> turn x + shift for places, turn v for directions.
struct Placement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< a rotation
  Vector3 shift = Vector3::Zero();                     ///< m

  [[nodiscard]] Vector3 point(const Vector3& x) const { return turn * x + shift; }
  [[nodiscard]] Vector3 direction(const Vector3& v) const { return turn * v; }
  /// The inverse of point(): what is read in a placed scene, in the scene's own axes.
  [[nodiscard]] Vector3 point_back(const Vector3& x) const { return turn.transpose() * (x - shift); }
  /// The inverse of direction().
  [[nodiscard]] Vector3 direction_back(const Vector3& v) const { return turn.transpose() * v; }
};

/// Neither turned nor near the origin: a turn of 0.8 rad about (1, 2, 3), moved by (12, -30, 5).
[[nodiscard]] Placement some_placement();

/// Places of material points turned and moved: x -> turn x + shift, with the faces kept.
[[nodiscard]] Polyhedron placed(const Polyhedron& solid, const Placement& placement);

/// A block with its shape, supports, loads and points, turned and moved as a whole.
/// @throws std::invalid_argument if the placement turns and a support holds some components only: they are
/// along the axes of space, and the turned support would hold a direction that has no component
[[nodiscard]] BlockDefinition placed(BlockDefinition block, const Placement& placement);

/// Velocities turned.
[[nodiscard]] InitialMotion placed(const InitialMotion& motion, const Placement& placement);

}  // namespace ashlar

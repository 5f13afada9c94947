// A scene rotated and shifted as a whole. No direction of space is special in mechanics, so that the results of the
// placed scene are those of the scene, rotated and shifted likewise (program/verify/cases/scene_case_run.hpp).
//
// scene_placement.cpp is the register of directions, as model_position.cpp is that of positions: every key of a scene
// with a vector, a tensor, an orientation or a height is there.
#pragma once

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// A rotation and a shift: x -> turn x + shift for places, turn v for directions, turn S turn^T for tensors.
struct ScenePlacement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< a rotation
  Vector3 shift = Vector3::Zero();                     ///< m

  [[nodiscard]] bool is_turned() const { return turn != Eigen::Matrix3d::Identity(); }
  [[nodiscard]] bool is_identity() const { return !is_turned() && shift.isZero(0.0); }
  [[nodiscard]] Vector3 point(const Vector3& x) const { return turn * x + shift; }
  [[nodiscard]] Vector3 direction(const Vector3& v) const { return turn * v; }
  [[nodiscard]] Eigen::Matrix3d tensor(const Eigen::Matrix3d& s) const { return turn * s * turn.transpose(); }
  /// The inverse of point(): places of a placed scene in the scene's own axes.
  [[nodiscard]] Vector3 point_back(const Vector3& x) const { return turn.transpose() * (x - shift); }
  /// The inverse of direction().
  [[nodiscard]] Vector3 direction_back(const Vector3& v) const { return turn.transpose() * v; }
  /// The inverse of tensor().
  [[nodiscard]] Eigen::Matrix3d tensor_back(const Eigen::Matrix3d& s) const {
    return turn.transpose() * s * turn;
  }
};

/// A scene placed in the user's coordinates, as if the user had written it there: Scene::origin follows from the new
/// place. Without rotation and shift it is unchanged.
///
/// Blocks are rotated by `rotate`, boxes and spheres of regions and cuts become hulls. A cut that is turned over has a
/// dip of more than 90 degrees, so that its planes keep their numbers. Files of vectors and paths are replaced by their
/// rows. Formulas keep their text, which JSON has, but are evaluated at the place before and have rotated values.
/// @param scene as read, before it is cut (scene_reader.hpp)
/// @throws std::invalid_argument with the key and the reason if a part of the scene belongs to axes or places:
/// - supports of some components, and sides of the model that hold one of them until motion begins, with a rotation
/// - `fisher`, whose scatter is drawn about axes of its own, with a rotation
/// - patterns of bolts whose rows are then not horizontal
/// - heights: a level of water by points with a rotation; others if gravity is zero or has a history, where they are
///   along z, or if stages have several directions of gravity, unless the rotation is about z
/// - coordinates in files that are read later: tables of measured joints, meshes of regions and of cuts
[[nodiscard]] Scene placed(Scene scene, const ScenePlacement& placement);

}  // namespace ashlar

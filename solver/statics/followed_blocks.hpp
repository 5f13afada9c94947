// Rigid blocks on their way behind a support that moves (support_movement.hpp): where they lie, what their joints have
// been through, and the rigid model of the place.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "solver/statics/rigid_model.hpp"
#include "solver/statics/support_movement.hpp"

namespace ashlar {

/// How a support moves along its coordinate q: by q along a direction, or, where it lies around the structure, apart, as
/// if it broke between the blocks that stand on it. What bears a block moves level and away from the middle of the
/// structure, by q at the mean distance of such joints from there and in proportion elsewhere. Contacts are detected on a
/// support that is stretched, which agrees with that in the middle of each joint.
class SupportWay {
 public:
  /// @param model as placed. @param down of gravity, any length
  /// @throws std::invalid_argument if the support touches no body
  SupportWay(const RigidModel& model, int support, const Vector3& down,
             const std::optional<Vector3>& direction);

  /// Of length 1; empty: it spreads.
  [[nodiscard]] const std::optional<Vector3>& direction() const { return direction_; }
  /// m/m, of the support at a point that it has with a body, at q. @param q m
  [[nodiscard]] Vector3 velocity(const RigidPoint& point, double q) const;
  /// Coefficients of the support at q. @param position at 0
  [[nodiscard]] Eigen::MatrixX3d placed(const BlockModel& support, const Eigen::MatrixX3d& position,
                                        double q) const;

 private:
  int support_;
  Vector3 middle_, down_;
  double radius_ = 1.0;          ///< m, mean distance of joints from the middle
  std::map<int, Vector3> arms_;  ///< m, level, of the joint with each block
  std::optional<Vector3> direction_;
};

/// Where blocks lie, as a value.
struct Placement {
  double moved = 0.0;                         ///< q of the support, m
  std::vector<BlockState> states;             ///< by block
  std::vector<Eigen::Matrix3d> turn;          ///< of each block since it was placed
  std::map<std::array<int, 2>, double> slip;  ///< m, way of joints under pressure
};

class FollowedBlocks {
 public:
  /// @param reach m, gap up to which points are detected
  /// @throws std::invalid_argument as support_movement
  FollowedBlocks(const PlacedScene& scene, double reach);

  [[nodiscard]] Placement as_placed() const;
  /// Bodies and all points in reach, gaps in RigidPoint::contact.
  [[nodiscard]] RigidModel model_of(const Placement& placement) const;

  /// The farthest that a place of any body goes, m. @param way by body, in coordinates of the model
  [[nodiscard]] double largest_way(const RigidModel& model, const std::vector<BodyVelocity>& way) const;
  /// Moves bodies by exact rotations.
  void move(const RigidModel& model, const std::vector<BodyVelocity>& way, Placement& placement) const;
  void place_support(int support, const SupportWay& way, double q, Placement& placement) const;

 private:
  [[nodiscard]] double radius_about(const RigidBody& body) const;

  const PlacedScene& scene_;
  BlockSystem system_;          ///< with friction only, and points up to the reach
  std::vector<double> radius_;  ///< m, of each block about its centroid
};

/// The model half way through a motion: middles, places and frames of its points. Loads and gaps are as they were.
/// @param program its own, with or without the support. @param way m, by body of the programme
[[nodiscard]] RigidModel midway(const RigidModel& model, const ConeProgram& program,
                                const std::vector<BodyVelocity>& way);

/// Size of the smallest block that may move, m: the edge of the cube of its volume.
[[nodiscard]] double smallest_size(const BlockSystem& system, const RigidModel& model);

}  // namespace ashlar

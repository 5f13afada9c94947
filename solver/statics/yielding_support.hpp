// A support that gives way along one coordinate: how its places move, and the cone programme of what stands on it and
// beside it.
//
// Without a direction the support moves away from the structure at right angles to gravity: from the middle of gravity
// of all that may move to the middle of its contacts. A support that lies around the structure spreads: each of its
// joints moves away from that middle.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "solver/statics/rigid_model.hpp"

namespace ashlar {

/// Blocks that do not move and that one presses on which does, in ascending order.
[[nodiscard]] std::vector<int> supports_of(const RigidModel& model);

/// How a support moves along its coordinate q: by q along a direction, or, where it lies around the structure, apart, as
/// if it broke between the blocks that stand on it. What bears a block moves level and away from the middle of the
/// structure, by q at the mean distance of such joints from there and in proportion elsewhere. A support that is
/// stretched agrees with that in the middle of each joint.
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

/// x -> a x + c of the coefficients of a block. @param position (p, 3)
[[nodiscard]] Eigen::MatrixX3d mapped(const BlockModel& block, const Eigen::MatrixX3d& position,
                                      const Eigen::Matrix3d& a, const Vector3& c);

/// Of the support at a point that it has with a body, in m per m of the coordinate.
using SupportVelocity = std::function<Vector3(const RigidPoint& point)>;

/// The programme of a model with one more body behind the others, of one coordinate: the support that moves.
/// @param threads >= 1
[[nodiscard]] ConeProgram program_with_support(const RigidModel& model, int support,
                                               const SupportVelocity& velocity, int threads);

/// The load on the support's coordinate is lowered (sign 1) or raised (sign -1) as far as balance allows: the load is
/// -sign times the factor of the answer, and the support moves by `sign` in the motion that is dual to it.
[[nodiscard]] ConeQuestion question_of_support(const RigidModel& model, double sign);

/// The load has no bound: what stands at the support can be pressed as much as one likes.
[[nodiscard]] bool boundless(const ConeQuestion& question, const ConeAnswer& answer);

/// Forces in balance were found.
[[nodiscard]] bool is_balanced(const ConeAnswer& answer);

/// N, by point of the model, on its first block. @param in_frames in units of the model, as ConeAnswer::force
[[nodiscard]] std::vector<Vector3> forces_of(const RigidModel& model,
                                             const std::vector<Eigen::Vector3d>& in_frames);

}  // namespace ashlar

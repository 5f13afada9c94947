// A support that yields along one coordinate: the motion of its places, and the cone programme of the adjacent
// structure.
//
// Without a given direction the support moves away from the structure at right angles to gravity: from the centre of
// gravity of all moving blocks to the centroid of its contacts. A support around the structure spreads: each of its
// joints moves away from that centre.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "solver/limit/rigid_model.hpp"

namespace ashlar {

/// Fixed blocks under pressure of a moving one, in ascending order.
[[nodiscard]] std::vector<int> supports_of(const RigidModel& model);

/// Motion of a support along its coordinate q: by q along a direction, or, if it lies around the structure, apart as
/// if it were split between the blocks on it. The part that supports a block moves horizontally away from the centre
/// of the structure, by q at the mean distance of such joints from there and in proportion elsewhere. A stretched
/// support has the same motion at the centroid of each joint.
class MovementLaw {
 public:
  /// @param model as placed. @param down of gravity, any length
  /// @throws std::invalid_argument if the support touches no body
  MovementLaw(const RigidModel& model, int support, const Vector3& down,
              const std::optional<Vector3>& direction);

  /// Unit vector; empty: the support spreads.
  [[nodiscard]] const std::optional<Vector3>& direction() const { return direction_; }
  /// m/m, velocity of the support at a point that it has with a body, at q. @param q m
  [[nodiscard]] Vector3 velocity(const RigidPoint& point, double q) const;
  /// Coefficients of the support at q. @param position at 0
  [[nodiscard]] Eigen::MatrixX3d placed(const BlockModel& support, const Eigen::MatrixX3d& position,
                                        double q) const;

 private:
  int support_;
  Vector3 middle_, down_;
  double radius_ = 1.0;          ///< m, mean distance of joints from the middle
  std::map<int, Vector3> arms_;  ///< m, horizontal, of the joint with each block
  std::optional<Vector3> direction_;
};

/// Maps the coefficients of a block by x -> a x + c. @param position (p, 3)
[[nodiscard]] Eigen::MatrixX3d mapped(const BlockModel& block, const Eigen::MatrixX3d& position,
                                      const Eigen::Matrix3d& a, const Vector3& c);

/// Velocity of the support at a point that it has with a body, in m per m of the coordinate.
using SupportVelocity = std::function<Vector3(const RigidPoint& point)>;

/// The programme of a model with one additional body at the end, of one coordinate: the moving support.
/// @param threads >= 1
[[nodiscard]] ConeProgram program_with_support(const RigidModel& model, int support,
                                               const SupportVelocity& velocity, int threads);

/// Problem of lowering (sign 1) or raising (sign -1) the load on the support's coordinate as far as balance allows.
/// The load is -sign times the factor of the answer, and the support moves by `sign` in the dual motion.
[[nodiscard]] ConeQuestion question_of_support(const RigidModel& model, double sign);

/// Force over the loads that has no bound: smaller values mistake a structure that resists much for one that resists all,
/// with larger ones programmes lose digits.
inline constexpr double unbounded_over_loads = 1e3;

/// True if the load has no bound: the structure at the support resists any compression.
[[nodiscard]] bool boundless(const ConeQuestion& question, const ConeAnswer& answer);

/// True if forces in balance were found.
[[nodiscard]] bool is_balanced(const ConeAnswer& answer);

/// Forces by point of the model, on its first block, N. @param in_frames in units of the model, as ConeAnswer::force
[[nodiscard]] std::vector<Vector3> forces_of(const RigidModel& model,
                                             const std::vector<Eigen::Vector3d>& in_frames);

}  // namespace ashlar

// Joints whose tensile strength exceeds that of the cone of their friction and cohesion.
//
// The law of joint_law.hpp, with N the pressure of a joint, t its shear and mu, c, T its strength,
//     |t| <= c + mu max(N, 0),   N >= -T
// is a convex set of (N, t) only without friction. Its largest convex subsets with |t| = c at N = 0 have one slope m:
//     |t| <= c + m N,   -min(T, c/m) <= N,   0 <= m <= mu
// A programme has one of two of them for each joint:
//     pressed   m = mu:             all friction, and tension up to c/mu
//     pulled    m = min(mu, c/T):   all tensile strength, and less friction
// Both lie within the law, so that forces in balance within any choice prove that blocks stand. All points of a joint
// have the same slope: with tension at some and more friction under the pressure of others, a joint without load would
// press its faces together with T and resist shear by mu T.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/limit/rigid_model.hpp"

namespace ashlar {

/// The choice for each joint of a model, a joint being all contacts of two blocks.
class PulledJoints {
 public:
  explicit PulledJoints(const RigidModel& model);

  [[nodiscard]] JointUse use_of(std::size_t point) const {
    return joint_of_[point] < 0 ? JointUse::pressed : uses_[static_cast<std::size_t>(joint_of_[point])];
  }
  /// True if no joint has tensile strength.
  [[nodiscard]] bool empty() const { return uses_.empty(); }

  /// Chooses for each joint by its resultant: pulled where the slope of a pulled joint has the shear.
  /// @param force by point, in units of the model, within JointUse::either. @param factors on strengths, by point
  /// @return true if any choice has changed
  bool choose(const RigidModel& model, const std::vector<Eigen::Vector3d>& force,
              const std::vector<double>& factors);

 private:
  std::vector<int> joint_of_;   ///< by point; -1: a bar, or without tensile strength
  std::vector<JointUse> uses_;  ///< by joint
};

}  // namespace ashlar

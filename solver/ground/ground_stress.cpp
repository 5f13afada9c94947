#include "solver/ground/ground_stress.hpp"

#include <algorithm>

namespace ashlar {

StressField stress_at_rest(const GroundAtRest& ground) {
  const Vector3& up = ground.up;
  const Eigen::Matrix3d along = up * up.transpose();
  const Eigen::Matrix3d shape = along + ground.k0 * (Eigen::Matrix3d::Identity() - along);
  return [weight = ground.unit_weight, up, shape,
          surface = ground.surface](const Vector3& place) -> Eigen::Matrix3d {
    return -weight * std::max(0.0, surface - up.dot(place)) * shape;
  };
}

Eigen::Matrix3d symmetric_stress(std::span<const double, 6> components) {
  const auto& s = components;
  return (Eigen::Matrix3d() << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]).finished();
}

}  // namespace ashlar

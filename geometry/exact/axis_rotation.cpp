#include "geometry/exact/axis_rotation.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {

Eigen::Matrix3d rotation_matrix(const Vector3& axis, const DegreeTurn& turn) {
  Eigen::Matrix3d cross;
  cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  return turn.cosine * Eigen::Matrix3d::Identity() + (1.0 - turn.cosine) * axis * axis.transpose() +
         turn.sine * cross;
}

Eigen::Matrix3d rotation_matrix(const Vector3& rotation) {
  const double angle = rotation.stableNorm();
  if (!(angle > 0.0)) return Eigen::Matrix3d::Identity();
  return rotation_matrix(rotation / angle, {correctly_rounded::sin(angle), correctly_rounded::cos(angle)});
}

Vector3 rotation_vector(const Eigen::Matrix3d& matrix) {
  const Eigen::Quaterniond quaternion(matrix);
  const double sine = quaternion.vec().stableNorm();  // of half the angle
  if (!(sine > 0.0)) return Vector3::Zero();
  const double angle = 2.0 * correctly_rounded::atan2(sine, std::abs(quaternion.w()));
  return std::copysign(angle / sine, quaternion.w()) * quaternion.vec();
}

}  // namespace ashlar

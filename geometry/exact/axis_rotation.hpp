// Rotations about an axis, with sines and angles that are the same on every system (rounded_functions.hpp).
#pragma once

#include <Eigen/Core>

#include "geometry/exact/degree_turn.hpp"

namespace ashlar {

using Vector3 = Eigen::Vector3d;

/// Rodrigues' matrix c I + (1 - c) a a' + s [a]x. @param axis a, a unit vector
[[nodiscard]] Eigen::Matrix3d rotation_matrix(const Vector3& axis, const DegreeTurn& turn);

/// @param rotation axis times angle, rad
[[nodiscard]] Eigen::Matrix3d rotation_matrix(const Vector3& rotation);

/// Axis times angle, rad, angle 0 to pi. @param matrix orthogonal, of determinant 1
[[nodiscard]] Vector3 rotation_vector(const Eigen::Matrix3d& matrix);

}  // namespace ashlar

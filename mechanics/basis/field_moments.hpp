// Moments of vector fields over the reference volume V of a block, from their coefficients (theory.md
// section 1):
//
//   f(X) = sum_k phi_k(X) f_k,   integral phi_k phi_l dV = delta_kl,   phi_0 = 1 / sqrt(V)
//
// So an integral of a product is the sum of the products of coefficients, in any configuration of the block.
// Coefficient arrays are (p, 3), p >= 1, in the unit of the field times m^3/2.
#pragma once

#include <Eigen/Core>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

using FieldCoefficients = Eigen::Ref<const Eigen::MatrixX3d>;

/// Mean of a field over the volume; of a position the centroid. @param volume V, m^3
[[nodiscard]] Vector3 mean_of(const FieldCoefficients& field, double volume);

/// Coefficients of a position relative to a point. @param volume V, m^3
[[nodiscard]] Eigen::MatrixX3d from_point(const FieldCoefficients& position, double volume,
                                          const Vector3& point);

/// Integral of a x b. Without the first row of both it excludes the product of their means.
[[nodiscard]] Vector3 integral_of_cross(const FieldCoefficients& a, const FieldCoefficients& b);

/// Inertia at unit density about the origin of a position: integral of |x|^2 I - x x^T, m^5.
[[nodiscard]] Eigen::Matrix3d unit_inertia(const FieldCoefficients& position);

/// Coefficients of the field w x f.
[[nodiscard]] Eigen::MatrixX3d turning_field(const Vector3& w, const FieldCoefficients& field);

}  // namespace ashlar

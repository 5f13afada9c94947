// Linear elasticity in a corotational frame (theory.md section 4).
//
//   mean deformation gradient  F = q' G,  G the mean gradients of phi;   F = R U  (polar decomposition)
//   d = q R - q0  (each row is R' q_a - q0_a)                 deformation seen from the turning frame
//   E = 1/2 vec(d)' K vec(d)                                  K integrated once
//   dE/dq = (g + G N') R',  g = K d,  N = [n]x,  n = inverse(tr(U) I - U) sum_a g_a x (q0_a + d_a)
//
// The second term comes from the change of R with q. With it E is invariant under rotation and the internal force has
// no resultant torque. The tangent is R K R', which neglects terms of the size of the strain.
// Arrays of coefficients are (p, 3): row a belongs to phi_a, column i to the coordinate i. Stacked, they are
// column by column: entry i * p + a.
#pragma once

#include <Eigen/Dense>

#include "mechanics/basis/basis.hpp"
#include "mechanics/material/material.hpp"

namespace ashlar {

/// K of Hooke's law for displacements sum_a C_a(X) q_a. @return (3p, 3p), J/m^5 per coefficient pair,
/// symmetric, positive semi-definite with the six rigid motions as kernel (order >= 1)
[[nodiscard]] Eigen::MatrixXd elastic_stiffness(const PolynomialBasis& basis, const Material& material);

/// Mean gradients G of the basis functions over the block. @return (p, 3), m^-5/2
[[nodiscard]] Eigen::MatrixX3d mean_gradients(const PolynomialBasis& basis);

/// Rotation and stretch of a deformation gradient, R U = F with det R = +1.
struct PolarDecomposition {
  Eigen::Matrix3d rotation;
  Eigen::Matrix3d stretch;
};
[[nodiscard]] PolarDecomposition polar_decomposition(const Eigen::Matrix3d& deformation_gradient);

/// Energy, internal force and frame of one configuration.
struct ElasticResponse {
  double energy = 0.0;       ///< J
  Eigen::MatrixX3d force;    ///< dE/dq, (p, 3)
  Eigen::Matrix3d rotation;  ///< R, for the tangent R K R'
};

/// @param stiffness K, (3p, 3p)
/// @param gradients G, (p, 3)
/// @param reference q0, (p, 3)
/// @param coefficients q, (p, 3)
/// @param corotational false: R = I, small displacements, for blocks whose supports allow no rotation
[[nodiscard]] ElasticResponse elastic_response(const Eigen::MatrixXd& stiffness,
                                               const Eigen::MatrixX3d& gradients,
                                               const Eigen::MatrixX3d& reference,
                                               const Eigen::MatrixX3d& coefficients, bool corotational);

/// R K R' for stacked coefficients. @return (3p, 3p)
[[nodiscard]] Eigen::MatrixXd rotated_stiffness(const Eigen::MatrixXd& stiffness,
                                                const Eigen::Matrix3d& rotation);

/// Cauchy stress of Hooke's law at one point, rotated into the current frame.
/// @param displacement_gradient of the displacement seen from the turning frame. @return (3, 3), Pa, tension
/// positive
[[nodiscard]] Eigen::Matrix3d linear_stress(const Material& material,
                                            const Eigen::Matrix3d& displacement_gradient,
                                            const Eigen::Matrix3d& rotation);

}  // namespace ashlar

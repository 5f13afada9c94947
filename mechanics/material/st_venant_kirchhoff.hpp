// St.-Venant-Kirchhoff elasticity of one block, integrated exactly (theory.md section 4):
//
//   F = sum_a q_a (grad phi_a)',   E = (F'F - I)/2,   S = lambda tr(E) I + 2 mu E,
//   W = integral of lambda/2 tr(E)^2 + mu E:E dV,   dW/dq_a = integral of F S grad phi_a dV
//
// For order n, E is a polynomial of degree 2(n-1). Its coefficients c in an orthonormal basis of that order follow
// from its values at as many points, c = inverse(V) values, V the basis at the points. Integrals of products of two
// such polynomials are products of coefficients, so that the energy |c|^2 is exact, with (n-1)-fold fewer points than
// a quadrature of degree 4(n-1). The points are chosen well separated by a pivoted QR.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "mechanics/basis/basis.hpp"
#include "mechanics/material/elasticity.hpp"
#include "mechanics/material/material.hpp"

namespace ashlar {

/// Constant after construction. Coefficient arrays are (p, 3), stacked as in elasticity.hpp.
class StVenantKirchhoff {
 public:
  /// Limited by bases of order 2(n-1).
  static constexpr int max_order = 1 + PolynomialBasis::max_order / 2;

  /// @throws std::invalid_argument if the order of the basis is above max_order
  StVenantKirchhoff(const Polyhedron& solid, const PolynomialBasis& basis, const Material& material);

  /// Energy and force of a configuration; the frame is the identity.
  [[nodiscard]] ElasticResponse respond(const Eigen::MatrixX3d& coefficients) const;

  /// Second derivatives of the energy. @param without_stress leaves out the product of the stress with the second
  /// derivatives of the strain: the remainder is positive semi-definite
  /// @return (3p, 3p), symmetric
  [[nodiscard]] Eigen::MatrixXd tangent(const Eigen::MatrixX3d& coefficients, bool without_stress) const;

 private:
  using Tensor = std::array<Eigen::VectorXd, 6>;  ///< 11, 22, 33, 12, 23, 13: (#points) each

  /// F at the points. @return for each J: F_iJ by columns i, (#points, 3)
  [[nodiscard]] std::array<Eigen::MatrixX3d, 3> deformation(const Eigen::MatrixX3d& coefficients) const;
  /// Coefficients of E.
  [[nodiscard]] Tensor strain(const std::array<Eigen::MatrixX3d, 3>& deformation) const;
  /// Weights of the stress of a strain at the points: V^-T times its coefficients.
  [[nodiscard]] Tensor weighted_stress(const Tensor& strain) const;

  double lambda_;
  double mu_;
  std::array<Eigen::MatrixXd, 3> gradients_;  ///< d phi_a / dX_K at the points, (#points, p), m^-5/2
  Eigen::MatrixXd to_coefficients_;           ///< inverse(V), m^3/2
};

/// Cauchy stress F S F' / det F of a deformation gradient, Pa, tension positive.
[[nodiscard]] Eigen::Matrix3d st_venant_kirchhoff_stress(const Material& material,
                                                         const Eigen::Matrix3d& deformation_gradient);

}  // namespace ashlar

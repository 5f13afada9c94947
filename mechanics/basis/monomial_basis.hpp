// The monomial basis of the paper's equation (1), X^a Y^b Z^c, for comparison with the orthonormal one (theory.md
// section 2). Its condition worsens with the distance of the block from the origin of X.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "geometry/solid/polyhedron.hpp"
#include "mechanics/basis/multi_index.hpp"
#include "mechanics/material/material.hpp"

namespace ashlar {

/// Origin and unit of X, Y and Z in the monomials.
enum class MonomialOrigin {
  global,   ///< coordinates as given
  centred,  ///< from the block's centroid
  scaled,   ///< from the centroid, in half diagonals of the block's box
};

/// Constant after construction. Functions in the order of multi_index.hpp.
class MonomialBasis {
 public:
  /// @param solid reference shape, m. @param order 0 to 12
  MonomialBasis(const Polyhedron& solid, int order, MonomialOrigin origin);

  [[nodiscard]] int size() const { return polynomial_count(order_); }
  /// @return (#points, p)
  [[nodiscard]] Eigen::MatrixXd values(const std::vector<Vector3>& points) const;
  /// Integrals of products, from moments that are exact but for one rounding. @return (p, p), m^3
  [[nodiscard]] Eigen::MatrixXd gram() const;
  /// K of Hooke's law as in elasticity.hpp. @return (3p, 3p)
  [[nodiscard]] Eigen::MatrixXd stiffness(const Material& material) const;
  /// Integrals of the functions, m^3. @return (p)
  [[nodiscard]] Eigen::VectorXd integrals() const;

 private:
  /// Integral of (d f_r / dX_i)(d f_s / dX_j).
  [[nodiscard]] double gradient_product(int r, int i, int s, int j) const;

  int order_;
  Vector3 center_ = Vector3::Zero();
  double unit_ = 1.0;
  std::vector<std::array<int, 3>> exponents_;
  std::vector<double> moments_;  ///< of the scaled coordinates, to degree 2 order
};

}  // namespace ashlar

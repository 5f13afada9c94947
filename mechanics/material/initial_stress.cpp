#include "mechanics/material/initial_stress.hpp"

#include "mechanics/basis/quadrature.hpp"

namespace ashlar {
namespace {

/// Degree of a field of stress in space up to which its moments are exact: higher ones need more points.
constexpr int degree_of_stress = 4;

}  // namespace

Eigen::MatrixX3d initial_deformation(const Polyhedron& solid, const PolynomialBasis& basis,
                                     const Eigen::MatrixXd& stiffness, const StressField& stress) {
  const VolumeRule rule = volume_rule(solid.mesh(), basis.centroid(), basis.order() - 1 + degree_of_stress);
  const auto count = static_cast<Eigen::Index>(rule.points.size());
  Eigen::Matrix<double, Eigen::Dynamic, 9> weighted(count, 9);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto index = static_cast<std::size_t>(k);
    const Eigen::Matrix3d here = rule.weights[index] * stress(rule.points[index]);
    weighted.row(k) = Eigen::Map<const Eigen::Matrix<double, 1, 9>>(here.data());
  }
  // d phi / dX_j = D_j phi
  const Eigen::MatrixXd moments = basis.values(rule.points).transpose() * weighted;  // (p, 9)
  Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(basis.size(), 3);
  for (int j = 0; j < 3; ++j) force += basis.derivative(j) * moments.middleCols(3 * j, 3);
  // The six rigid motions are the kernel of K; the force does no work on them, as s is symmetric.
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factor(stiffness);
  const Eigen::VectorXd solution =
      factor.solve(Eigen::Map<const Eigen::VectorXd>(force.data(), force.size()));
  return Eigen::Map<const Eigen::MatrixX3d>(solution.data(), basis.size(), 3);
}

}  // namespace ashlar

#include "mechanics/material/st_venant_kirchhoff.hpp"

#include <gtest/gtest.h>

#include "support/check_derivatives.hpp"
#include "support/sample_solids.hpp"
#include "support/simulations.hpp"

namespace ashlar::st_venant_kirchhoff_test {
namespace {

const Material rubber{1000.0, 5e6, 0.3, Elasticity::st_venant_kirchhoff};

Eigen::MatrixX3d bent(const PolynomialBasis& basis, double size) {
  Eigen::MatrixX3d q = basis.identity_map();
  for (Eigen::Index a = 0; a < q.rows(); ++a)
    q.row(a) += size * Vector3(std::sin(a + 1.0), std::cos(2.0 * a), std::sin(3.0 * a)).transpose();
  return q;
}

/// Energy by an independent quadrature.
double energy_by_quadrature(const Polyhedron& solid, const PolynomialBasis& basis,
                            const Eigen::MatrixX3d& q) {
  double sum = 0.0;
  for (const auto& [point, weight] : test_support::volume_rule(solid, 4 * (basis.order() - 1))) {
    const Eigen::Matrix3d f = q.transpose() * basis.gradients(point);
    const Eigen::Matrix3d e = 0.5 * (f.transpose() * f - Eigen::Matrix3d::Identity());
    sum += weight * (0.5 * rubber.lame_lambda() * e.trace() * e.trace() + rubber.lame_mu() * e.squaredNorm());
  }
  return sum;
}

TEST(StVenantKirchhoff, EnergyIsIntegratedExactly) {
  for (const auto& [name, solid] : test_support::sample_solids()) {
    if (name == "far box" || name == "plate") continue;
    for (const int order : {1, 2, 4}) {
      const PolynomialBasis basis(solid, order);
      const StVenantKirchhoff elasticity(solid, basis, rubber);
      const Eigen::MatrixX3d q = bent(basis, 0.05);
      const double expected = energy_by_quadrature(solid, basis, q);
      EXPECT_NEAR(elasticity.respond(q).energy, expected, 1e-11 * expected) << name << order;
    }
  }
}

TEST(StVenantKirchhoff, ForceAndTangentAreDerivatives) {
  const Polyhedron solid = test_support::l_shaped_prism();
  const PolynomialBasis basis(solid, 3);
  const StVenantKirchhoff elasticity(solid, basis, rubber);
  const Eigen::MatrixX3d q = bent(basis, 0.05);
  const Eigen::Index p = q.rows();
  const auto unstacked = [&](const Eigen::VectorXd& x) {
    return Eigen::MatrixX3d(Eigen::Map<const Eigen::MatrixX3d>(x.data(), p, 3));
  };
  const auto stacked = [&](const Eigen::MatrixX3d& x) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(x.data(), 3 * p));
  };
  const auto energy = [&](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, elasticity.respond(unstacked(x)).energy));
  };
  const auto force = [&](const Eigen::VectorXd& x) {
    return stacked(elasticity.respond(unstacked(x)).force);
  };
  test_support::expect_derivative(energy, stacked(q), force(stacked(q)).transpose(), 1e-5, 1e-7);
  test_support::expect_derivative(force, stacked(q), elasticity.tangent(q, false), 1e-5, 1e-7);
}

TEST(StVenantKirchhoff, TangentOfTheUndeformedBlockIsHookes) {
  const Polyhedron solid = test_support::l_shaped_prism();
  for (const int order : {1, 3}) {
    const PolynomialBasis basis(solid, order);
    const StVenantKirchhoff elasticity(solid, basis, rubber);
    const Eigen::MatrixXd stiffness = elastic_stiffness(basis, rubber);
    const Eigen::MatrixXd tangent = elasticity.tangent(basis.identity_map(), false);
    EXPECT_LT((tangent - stiffness).norm(), 1e-11 * stiffness.norm());
    EXPECT_LT((elasticity.tangent(basis.identity_map(), true) - stiffness).norm(), 1e-11 * stiffness.norm());
  }
}

TEST(StVenantKirchhoff, RotationAddsNothing) {
  const Polyhedron solid = test_support::l_shaped_prism();
  const PolynomialBasis basis(solid, 3);
  const StVenantKirchhoff elasticity(solid, basis, rubber);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  // Rounding of F'F - I is all that is left: a few 1e-16 in strain.
  const double rounding = 3.0 * rubber.young_modulus * 1e-30;
  EXPECT_LT(elasticity.respond(basis.identity_map() * turn.transpose()).energy, rounding * 100.0);
  const Eigen::MatrixX3d q = bent(basis, 0.05);
  const ElasticResponse straight = elasticity.respond(q);
  const ElasticResponse turned = elasticity.respond(q * turn.transpose());
  EXPECT_NEAR(turned.energy, straight.energy, 1e-12 * straight.energy);
  EXPECT_LT((turned.force - straight.force * turn.transpose()).norm(), 1e-11 * straight.force.norm());
}

TEST(StVenantKirchhoff, TangentWithoutStressIsPositive) {
  const Polyhedron solid(make_box({0, 0, 0}, {4, 1, 1}));
  const PolynomialBasis basis(solid, 2);
  const StVenantKirchhoff elasticity(solid, basis, rubber);
  const Eigen::MatrixX3d squeezed = basis.identity_map() * Vector3(0.6, 1, 1).asDiagonal();
  const auto least = [&](bool without_stress) {
    const Eigen::MatrixXd tangent = elasticity.tangent(squeezed, without_stress);
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(tangent).eigenvalues()[0] / tangent.norm();
  };
  EXPECT_LT(least(false), -1e-3);
  EXPECT_GT(least(true), -1e-12);
}

TEST(StVenantKirchhoff, StressOfAStretchedBar) {
  // Stretch 1.5 and no change across, nu 0: S = E (1.5^2 - 1)/2, sigma = 1.5 S.
  const Material bar{1000.0, 8.0, 0.0, Elasticity::st_venant_kirchhoff};
  const Eigen::Matrix3d f = Vector3(1.5, 1, 1).asDiagonal();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d expected = turn * Vector3(7.5, 0, 0).asDiagonal() * turn.transpose();
  EXPECT_LT((st_venant_kirchhoff_stress(bar, turn * f) - expected).norm(), 1e-13);
}

TEST(StVenantKirchhoff, RefusesOrdersWithoutABasisForTheStrain) {
  BlockDefinition block = test_support::block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rubber, 8);
  EXPECT_THROW(BlockModel{block}, std::invalid_argument);
}

TEST(StVenantKirchhoff, HeldBarUnderTractionIsInEquilibrium) {
  // One end on rollers, dead traction t on the other: the first Piola-Kirchhoff stress is t = l E (l^2 -
  // 1)/2.
  const Material bar{1000.0, 8.0, 0.0, Elasticity::st_venant_kirchhoff};
  BlockDefinition definition =
      test_support::block_of("A", Polyhedron(make_box({0, 0, 0}, {2, 1, 1})), bar, 2);
  definition.supports.push_back({Plane{{0, 0, 0}, {1, 0, 0}}});
  definition.loads.push_back({Plane{{2, 0, 0}, {1, 0, 0}}, true, {7.5, 0, 0}, {}});
  const BlockModel block(std::move(definition));
  const auto position = block.equilibrium(Vector3::Zero(), 0.0);
  ASSERT_TRUE(position.has_value());
  for (const Vector3& point : {Vector3(2, 0, 0), Vector3(1, 0.5, 0.3)}) {
    const Vector3 place = position->transpose() * block.basis().values(point);
    EXPECT_LT((place - Vector3(1.5 * point.x(), point.y(), point.z())).norm(), 1e-10);
  }
}

}  // namespace
}  // namespace ashlar::st_venant_kirchhoff_test

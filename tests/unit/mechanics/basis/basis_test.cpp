#include "mechanics/basis/basis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/solid/shapes.hpp"
#include "mechanics/basis/moments.hpp"
#include "support/sample_solids.hpp"

namespace ashlar::basis_test {
namespace {

// By a quadrature that is independent of the program's moments.
double orthonormality_error(const Polyhedron& solid, int order) {
  const PolynomialBasis basis(solid, order);
  const auto rule = test_support::volume_rule(solid, 2 * order);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(basis.size(), basis.size());
  constexpr std::size_t batch = 1000;
  for (std::size_t start = 0; start < rule.size(); start += batch) {
    std::vector<Vector3> points;
    Eigen::VectorXd weights(static_cast<Eigen::Index>(std::min(batch, rule.size() - start)));
    for (Eigen::Index k = 0; k < weights.size(); ++k) {
      points.push_back(rule[start + static_cast<std::size_t>(k)].first);
      weights[k] = rule[start + static_cast<std::size_t>(k)].second;
    }
    const Eigen::MatrixXd phi = basis.values(points);
    gram.noalias() += phi.transpose() * weights.asDiagonal() * phi;
  }
  return (gram - Eigen::MatrixXd::Identity(basis.size(), basis.size())).norm();
}

Polyhedron turned(const Polyhedron& solid) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vector3> points;
  for (const Vector3& point : solid.mesh().points) points.emplace_back(turn * point);
  return solid.with_points(std::move(points));
}

TEST(Basis, IsOrthonormalOnConvexAndNonConvexSolids) {
  for (const auto& [name, solid] : test_support::sample_solids()) {
    // Points of the far box are themselves rounded at 1e-13 of its size.
    const double tolerance = name == "far box" ? 1e-11 : 1e-12;
    for (const int order : {1, 2, 3, 5, 8}) {
      EXPECT_LT(orthonormality_error(solid, order), tolerance) << name << order;
      if (name != "far box") {
        // Turned points of the plate are rounded at 400 times the last place of its thickness.
        EXPECT_LT(orthonormality_error(turned(solid), order), name == "plate" ? 1e-11 : tolerance)
            << name << order;
      }
    }
  }
}

TEST(Basis, IsOrthonormalAtTheLargestOrder) {
  for (const auto& [name, solid] : test_support::sample_solids()) {
    if (name == "tetrahedron" || name == "hull") {
      EXPECT_LT(orthonormality_error(solid, PolynomialBasis::max_order), 1e-12) << name;
    }
  }
}

TEST(Basis, IsGraded) {
  const Polyhedron solid = test_support::l_shaped_prism();
  const PolynomialBasis low(solid, 2);
  const PolynomialBasis high(solid, 5);
  const Vector3 point(0.3, 0.7, 0.2);
  EXPECT_LT((high.values(point).head(low.size()) - low.values(point)).norm(),
            1e-13 * low.values(point).norm());
}

TEST(Basis, ReproducesPositionsAndLinearFields) {
  for (const auto& [name, solid] : test_support::sample_solids()) {
    const PolynomialBasis basis(solid, 4);
    const Vector3 point = solid.mesh().points[2];
    const double size = point.norm() + 1.0;
    EXPECT_LT((basis.identity_map().transpose() * basis.values(point) - point).norm(), 1e-13 * size) << name;
    const Eigen::Matrix3d gradient = (Eigen::Matrix3d() << 1, 2, 3, -4, 5, 6, 7, -8, 9).finished();
    const Vector3 value(0.5, -0.25, 2.0);
    const Vector3 expected = value + gradient * (point - basis.centroid());
    EXPECT_LT((basis.linear_field(value, gradient).transpose() * basis.values(point) - expected).norm(),
              1e-12 * (expected.norm() + gradient.norm() * size))
        << name;
  }
}

TEST(Basis, GradientsAreDerivativesOfValues) {
  const PolynomialBasis basis(test_support::l_shaped_prism(), 6);
  const Vector3 point(0.4, 0.2, 0.6);
  const Eigen::MatrixX3d gradient = basis.gradients(point);
  const double h = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 step = h * Vector3::Unit(axis);
    const Eigen::VectorXd difference = (basis.values(point + step) - basis.values(point - step)) / (2 * h);
    EXPECT_LT((difference - gradient.col(axis)).norm(), 1e-6 * gradient.norm());
  }
}

TEST(Basis, VolumeCentroidAndSecondMomentOfABoxFarAway) {
  const PolynomialBasis basis(Polyhedron(make_box({100, 200, 300}, {102, 206, 301})), 1);
  EXPECT_NEAR(basis.volume(), 12.0, 1e-13);
  EXPECT_LT((basis.centroid() - Vector3(101, 203, 300.5)).norm(), 1e-12);
  // V a^2 / 12 for sides 2, 6, 1.
  EXPECT_LT((basis.second_moment() - Eigen::Matrix3d(Vector3(4.0, 36.0, 1.0).asDiagonal())).norm(), 1e-12);
}

TEST(Basis, RefusesOrdersOutOfRange) {
  const Polyhedron cube(make_box({0, 0, 0}, {1, 1, 1}));
  EXPECT_THROW(PolynomialBasis(cube, -1), std::invalid_argument);
  EXPECT_THROW(PolynomialBasis(cube, 13), std::invalid_argument);
}

/// An L of two square arms of length 1.
Polyhedron thin_ell(double thickness) {
  const Polyhedron solid = test_support::l_shaped_prism();
  std::vector<Vector3> points;
  for (const Vector3& point : solid.mesh().points) {
    const auto stretched = [&](double x) { return x == 2.0 ? 1.0 : x * thickness; };
    points.emplace_back(stretched(point.x()), stretched(point.y()), point.z() * thickness);
  }
  return solid.with_points(std::move(points));
}

TEST(PolynomialBasis, OrdersThatAShapeDoesNotBearAreRefusedWithTheHighestThatItDoes) {
  // Arms of a thousandth of their length fill a thousandth of their box.
  for (const double thickness : {1e-3, 1e-6}) {
    const Polyhedron solid = thin_ell(thickness);
    for (const int order : {10, 12}) {
      try {
        const PolynomialBasis basis(solid, order);
        FAIL() << "accepted with a loss of " << basis.loss();
      } catch (const OrderTooHigh& error) {
        const int highest = error.highest_safe_order;
        ASSERT_GE(highest, 1);
        ASSERT_LT(highest, order);
        EXPECT_LE(PolynomialBasis(solid, highest).loss(), PolynomialBasis::allowed_loss);
        EXPECT_THROW(PolynomialBasis(solid, highest + 1), OrderTooHigh);
      }
    }
  }
}

// D = inverse(L) S L, and S commute. In too few digits D would lose as many as inverse(L) and L are large; as it is, each
// product is rounded in its last place only.
TEST(PolynomialBasis, DerivativesCommuteForAllShapesThatAreAccepted) {
  int accepted = 0;
  for (const double thickness : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    for (const int order : {2, 4, 7, 10}) {
      try {
        const PolynomialBasis basis(turned(thin_ell(thickness)), order);
        const Eigen::MatrixXd &x = basis.derivative(0), &y = basis.derivative(1);
        EXPECT_LT((x * y - y * x).norm(), 1e-15 * x.norm() * y.norm()) << thickness << ", order " << order;
        ++accepted;
      } catch (const OrderTooHigh&) {
      }
    }
  }
  EXPECT_GE(accepted, 10);
}

TEST(PolynomialBasis, CompactShapesLoseNothingToSpeakOf) {
  for (const auto& [name, solid] : test_support::sample_solids())
    EXPECT_LT(PolynomialBasis(solid, 8).loss(), 1e-11) << name;
}

}  // namespace
}  // namespace ashlar::basis_test

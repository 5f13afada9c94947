#include "mechanics/basis/field_moments.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/shapes.hpp"
#include "mechanics/basis/basis.hpp"

namespace ashlar::field_moments_test {
namespace {

/// 2 x 1 x 3, V = 6, centroid (2, 2.5, -0.5). Integral of (x - centroid)_i^2 is V l_i^2 / 12: 2, 1/2, 9/2.
PolynomialBasis box_basis() {
  return {Polyhedron(make_box({1, 2, -2}, {3, 3, 1})), 2};
}

TEST(FieldMoments, MeanOfAPositionIsTheCentroid) {
  const PolynomialBasis basis = box_basis();
  EXPECT_LT((mean_of(basis.identity_map(), 6.0) - Vector3(2, 2.5, -0.5)).norm(), 1e-14);
  const Eigen::MatrixX3d arms = from_point(basis.identity_map(), 6.0, {1, 1, 1});
  EXPECT_LT((mean_of(arms, 6.0) - Vector3(1, 1.5, -1.5)).norm(), 1e-14);
  // Only the mean changes.
  EXPECT_EQ(arms.bottomRows(arms.rows() - 1), basis.identity_map().bottomRows(arms.rows() - 1));
}

TEST(FieldMoments, InertiaOfABox) {
  const PolynomialBasis basis = box_basis();
  Eigen::Matrix3d expected = Vector3(0.5 + 4.5, 2.0 + 4.5, 2.0 + 0.5).asDiagonal();
  const auto about = [&](const Vector3& point) {
    return unit_inertia(from_point(basis.identity_map(), 6.0, point));
  };
  EXPECT_LT((about({2, 2.5, -0.5}) - expected).norm(), 1e-13);
  // Steiner with d = (1, 2, -3), |d|^2 = 14, V = 6.
  expected += 6.0 * (Eigen::Matrix3d() << 13, -2, 3, -2, 10, 6, 3, 6, 5).finished();
  EXPECT_LT((about({1, 0.5, 2.5}) - expected).norm(), 1e-12);
}

TEST(FieldMoments, CrossOfLinearFields) {
  // a = (3, 0, 1) + (y, 0, 0), b = (0, 2, 0) + (0, y, x), both of x - centroid:
  // V (3, 0, 1) x (0, 2, 0) = 6 (-2, 0, 6), and (y, 0, 0) x (0, y, x) = (0, -x y, y^2) is (0, 0, 1/2).
  const PolynomialBasis basis = box_basis();
  const auto field = [&](const Vector3& mean, const Eigen::Matrix3d& gradient) {
    return basis.linear_field(mean, gradient);
  };
  const Eigen::MatrixX3d a = field({3, 0, 1}, (Eigen::Matrix3d() << 0, 1, 0, 0, 0, 0, 0, 0, 0).finished());
  const Eigen::MatrixX3d b = field({0, 2, 0}, (Eigen::Matrix3d() << 0, 0, 0, 0, 1, 0, 1, 0, 0).finished());
  EXPECT_LT((integral_of_cross(a, b) - Vector3(-12, 0, 36.5)).norm(), 1e-12);
  const Eigen::Index others = a.rows() - 1;
  EXPECT_LT((integral_of_cross(a.bottomRows(others), b.bottomRows(others)) - Vector3(0, 0, 0.5)).norm(),
            1e-13);
}

TEST(FieldMoments, CrossIsTheSumOverAllFunctions) {
  // (1, 0, 0) x (0, 1, 0) + (0, 2, 0) x (0, 0, 3) + (1, 1, 0) x (1, 0, 1) = (0, 0, 1) + (6, 0, 0) + (1, -1,
  // -1)
  const Eigen::MatrixX3d a = (Eigen::MatrixX3d(3, 3) << 1, 0, 0, 0, 2, 0, 1, 1, 0).finished();
  const Eigen::MatrixX3d b = (Eigen::MatrixX3d(3, 3) << 0, 1, 0, 0, 0, 3, 1, 0, 1).finished();
  EXPECT_EQ(integral_of_cross(a, b), Vector3(7, -1, 0));
  // w = (0, 0, 2): w x (x, y, z) = (-2 y, 2 x, 0).
  EXPECT_EQ(turning_field({0, 0, 2}, a), (Eigen::MatrixX3d(3, 3) << 0, 2, 0, -4, 0, 0, -2, 2, 0).finished());
}

TEST(FieldMoments, SpinOfABoxIsItsInertiaTimesTheTurn) {
  const PolynomialBasis basis = box_basis();
  const Eigen::MatrixX3d arms = from_point(basis.identity_map(), 6.0, {2, 2.5, -0.5});
  const Vector3 turn(1, -2, 4);
  EXPECT_LT((integral_of_cross(arms, turning_field(turn, arms)) - Vector3(5, -13, 10)).norm(), 1e-12);
}

}  // namespace
}  // namespace ashlar::field_moments_test

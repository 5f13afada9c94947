#include "solver/contact/block_rows.hpp"

#include <gtest/gtest.h>

#include <random>

#include "geometry/solid/shapes.hpp"

namespace ashlar::block_rows_test {
namespace {

Eigen::VectorXd force(const BlockRows& rows, const Eigen::Matrix3Xd& forces) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows.unknowns());
  rows.add_force(forces, 1.0, sum);
  return sum;
}

/// A box, its basis and values of its functions at some points.
struct Subject {
  Polyhedron solid{make_box({0, 0, 0}, {2, 1, 1})};
  PolynomialBasis basis;
  std::vector<Vector3> points = {{2, 0.2, 0.3}, {2, 0.9, 0.1}, {1.5, 1, 0.7}, {0.3, 0.4, 1}};
  explicit Subject(int order) : basis(solid, order) {}
};

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> some(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return some(generator); });
}

/// Motion, forces and tangents compared with the definitions with all coefficients, x = sum_a phi_a q_a.
void expect_as_defined(const AdmissibleSpace& space, const Subject& subject) {
  const Eigen::MatrixXd phi = subject.basis.values(subject.points);
  const BlockRows rows(space, phi);
  const auto count = static_cast<Eigen::Index>(subject.points.size());
  ASSERT_EQ(rows.unknowns(), space.unknowns());
  const Eigen::VectorXd y = random_matrix(rows.unknowns(), 1, 1);
  Eigen::Matrix3Xd motion = Eigen::Matrix3Xd::Zero(3, count);
  rows.add_motion(y, -2.0, motion);
  const Eigen::Matrix3Xd expected = -2.0 * (phi * space.expand(y)).transpose();
  EXPECT_LT((motion - expected).norm(), 1e-13);
  const Eigen::Matrix3Xd forces = random_matrix(3, count, 2);
  const Eigen::MatrixX3d on_functions = phi.transpose() * forces.transpose();
  EXPECT_LT((force(rows, forces) - space.restrict(on_functions)).norm(), 1e-13);
  PointStiffnesses stiffnesses(9, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Matrix3d root = random_matrix(3, 3, static_cast<unsigned>(3 + k));
    stiffnesses.col(k) = (root * root.transpose()).reshaped();
  }
  // Column n of the tangent is the force of the stiffnesses on a motion of unknown n alone.
  const Eigen::MatrixXd tangent = rows.tangent(stiffnesses, rows);
  for (Eigen::Index n = 0; n < rows.unknowns(); ++n) {
    Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, count);
    rows.add_motion(Eigen::VectorXd::Unit(rows.unknowns(), n), 1.0, moved);
    for (Eigen::Index k = 0; k < count; ++k)
      moved.col(k) = (stiffnesses.col(k).reshaped(3, 3) * moved.col(k)).eval();
    EXPECT_LT((tangent.col(n) - force(rows, moved)).norm(), 1e-12);
  }
  const Vector3 direction(0.6, 0.0, 0.8);
  for (Eigen::Index k = 0; k < count; ++k) {
    Eigen::Matrix3Xd unit = Eigen::Matrix3Xd::Zero(3, count);
    unit.col(k) = direction;
    EXPECT_NEAR(rows.squared_row(k, direction), force(rows, unit).squaredNorm(), 1e-13);
  }
}

TEST(BlockRows, AreThoseOfAFreeBlock) {
  for (const int order : {1, 3}) {
    const Subject subject(order);
    expect_as_defined(AdmissibleSpace(subject.basis.size()), subject);
  }
}

TEST(BlockRows, AreThoseOfABlockWhoseComponentsAreHeldDifferently) {
  const Subject subject(3);
  BlockSupport support;
  support.where = Plane{{0, 0, 0}, {-1, 0, 0}};
  support.components = {true, false, true};
  expect_as_defined(AdmissibleSpace(subject.solid, subject.basis, {support}), subject);
}

TEST(BlockRows, TangentOfTwoBlocksIsThatOfTheirRows) {
  const Subject one(1);
  const Subject other(2);
  BlockSupport support;
  support.where = Plane{{0, 0, 0}, {-1, 0, 0}};
  const AdmissibleSpace held(other.solid, other.basis, {support});
  for (const bool free : {true, false}) {
    const BlockRows a(AdmissibleSpace(one.basis.size()), one.basis.values(one.points));
    const BlockRows b(free ? AdmissibleSpace(other.basis.size()) : held, other.basis.values(one.points));
    PointStiffnesses stiffnesses(9, 4);
    for (Eigen::Index k = 0; k < 4; ++k) {
      const Eigen::Matrix3d root = random_matrix(3, 3, static_cast<unsigned>(7 + k));
      stiffnesses.col(k) = (root + root.transpose()).reshaped();
    }
    const Eigen::MatrixXd tangent = a.tangent(stiffnesses, b);
    ASSERT_EQ(tangent.rows(), a.unknowns());
    ASSERT_EQ(tangent.cols(), b.unknowns());
    for (Eigen::Index n = 0; n < b.unknowns(); ++n) {
      Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, 4);
      b.add_motion(Eigen::VectorXd::Unit(b.unknowns(), n), 1.0, moved);
      for (Eigen::Index k = 0; k < 4; ++k)
        moved.col(k) = (stiffnesses.col(k).reshaped(3, 3) * moved.col(k)).eval();
      EXPECT_LT((tangent.col(n) - force(a, moved)).norm(), 1e-12);
    }
  }
}

TEST(BlockRows, SomePointsAreThoseOfAll) {
  const Subject subject(2);
  const BlockRows all(AdmissibleSpace(subject.basis.size()), subject.basis.values(subject.points));
  const BlockRows some = all.at_points({2, 0});
  const Eigen::VectorXd y = random_matrix(all.unknowns(), 1, 5);
  Eigen::Matrix3Xd of_all = Eigen::Matrix3Xd::Zero(3, 4);
  Eigen::Matrix3Xd of_some = Eigen::Matrix3Xd::Zero(3, 2);
  all.add_motion(y, 1.0, of_all);
  some.add_motion(y, 1.0, of_some);
  EXPECT_LT((of_some.col(0) - of_all.col(2)).norm(), 1e-15);
  EXPECT_LT((of_some.col(1) - of_all.col(0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(some.squared_row(1, Vector3::UnitY()), all.squared_row(0, Vector3::UnitY()));
  const BlockRows none = all.at_points({});
  EXPECT_EQ(none.tangent(PointStiffnesses(9, 0), none),
            Eigen::MatrixXd::Zero(all.unknowns(), all.unknowns()));
}

TEST(BlockRows, OfAFixedBlockThereAreNone) {
  const BlockRows rows;
  EXPECT_TRUE(rows.fixed());
  EXPECT_EQ(rows.unknowns(), 0);
  Eigen::Matrix3Xd motion = Eigen::Matrix3Xd::Ones(3, 2);
  rows.add_motion({}, 1.0, motion);
  EXPECT_EQ(motion, Eigen::Matrix3Xd::Ones(3, 2));
}

}  // namespace
}  // namespace ashlar::block_rows_test

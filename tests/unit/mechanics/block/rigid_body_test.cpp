#include "mechanics/block/rigid_body.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geometry/solid/shapes.hpp"
#include "mechanics/block/block_model.hpp"
#include "support/simulations.hpp"

namespace ashlar::rigid_body_test {
namespace {

const BlockModel& needle() {
  static const BlockModel block(test_support::block_of(
      "needle", Polyhedron(make_box({3, 4, 5}, {3.01, 4.02, 9})), {2000, 1e9, 0.2}, 0));
  return block;
}

Eigen::MatrixX3d placed(const Eigen::Matrix3d& turn, const Vector3& displacement) {
  Eigen::MatrixX3d position = needle().basis().identity_map() * turn.transpose();
  position.row(0) = needle().basis().identity_map().row(0) + displacement.transpose();
  return position;
}

Eigen::Matrix3d turned(double angle, const Vector3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

TEST(RigidBody, FieldsAreOrthonormalAndDoNotStrain) {
  const Eigen::MatrixX3d position = placed(turned(2.0, {1, 2, 3}), {7, 8, 9});
  const Eigen::MatrixXd fields = rigid_fields(position);
  EXPECT_LT((fields.transpose() * fields - Eigen::MatrixXd::Identity(6, 6)).norm(), 1e-12);
  const Eigen::Matrix3d gradient = position.transpose() * needle().parts()->mean_gradients;
  for (int k = 0; k < 6; ++k) {
    const Eigen::MatrixX3d field = needle().space().expand(fields.col(k));
    const Eigen::Matrix3d rate = field.transpose() * needle().parts()->mean_gradients * gradient.transpose();
    EXPECT_LT((rate + rate.transpose()).norm(), 1e-10 * (1.0 + rate.norm()));
  }
}

TEST(RigidBody, AVelocityFieldTranslatesAndTurns) {
  const Eigen::MatrixX3d position = placed(turned(0.7, {1, -2, 1}), {1, 2, 3});
  const Vector3 about(1, 0, 2), translation(0.5, -1, 2), rotation(0.1, 0.4, -0.3);
  const Eigen::MatrixX3d velocity =
      rigid_velocity(position, needle().basis().volume(), about, translation, rotation);
  for (const Vector3& reference : {Vector3(3, 4, 5), Vector3(3.01, 4.01, 8)}) {
    const Eigen::VectorXd value = needle().basis().values(reference);
    const Vector3 place = position.transpose() * value;
    EXPECT_LT((velocity.transpose() * value - translation - rotation.cross(place - about)).norm(), 1e-10);
  }
}

/// Any two rigid positions differ by a rigid change, which stays as it is, at any angle but half a turn.
TEST(RigidBody, ARigidChangeStaysAsItIs) {
  const Eigen::MatrixX3d start = placed(turned(0.7, {1, -2, 1}), {1, 2, 3});
  for (const double angle : {1e-12, 1e-6, 0.1, 1.5, 3.0}) {
    const Eigen::MatrixX3d end = placed(turned(angle, {3, 1, -2}) * turned(0.7, {1, -2, 1}), {1, 2, 4});
    const Eigen::MatrixX3d change = end - start;
    EXPECT_LT((rigid_change(start, change) - change).norm(), 1e-12 * start.norm()) << angle;
  }
}

/// Relative to the change: of 1e-12 rad there are no more than 4 digits in a difference of positions.
TEST(RigidBody, SmallChangesAreExactToTheirSize) {
  const Eigen::MatrixX3d start = placed(turned(0.7, {1, -2, 1}), {1, 2, 3});
  const Eigen::VectorXd field = rigid_fields(start).col(4);
  const Eigen::MatrixX3d change = 1e-12 * needle().space().expand(field);
  // The fields are those of the start, not of the middle, a turn of 3e-11 apart.
  EXPECT_LT((rigid_change(start, change) - change).norm(), 1e-10 * change.norm());
}

/// A change with strain also ends in a rotation.
TEST(RigidBody, OtherChangesBecomeRigid) {
  const Eigen::MatrixX3d start = placed(turned(0.7, {1, -2, 1}), {1, 2, 3});
  Eigen::MatrixX3d change = 0.3 * start;
  change.row(2) += Eigen::RowVector3d(1e-3, 0.2, -0.1);
  const Eigen::MatrixX3d end = start + rigid_change(start, change);
  EXPECT_EQ(end.row(0), start.row(0) + change.row(0));
  const Eigen::Matrix3d gradient = end.transpose() * needle().parts()->mean_gradients;
  EXPECT_LT((gradient.transpose() * gradient - Eigen::Matrix3d::Identity()).norm(), 1e-10);
  EXPECT_GT(gradient.determinant(), 0.0);
}

}  // namespace
}  // namespace ashlar::rigid_body_test

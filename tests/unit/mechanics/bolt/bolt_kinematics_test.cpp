#include "mechanics/bolt/bolt_kinematics.hpp"

#include <gtest/gtest.h>

#include "support/check_derivatives.hpp"

namespace ashlar::bolt_kinematics_test {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

BoltShape three_pieces() {
  BoltLaw law;
  law.axial_stiffness = 1e8;
  law.bond_stiffness = 1e9;
  law.shear_stiffness = 1e7;
  return {law, {1, 2, 3}, {1, 2, 8}, {{0, 1, 0.0, 2.0}, {1, 2, 2.0, 3.0}, {2, 1, 3.5, 5.0}}, 0.03};
}

BoltPlaces as_placed(const BoltShape& shape) {
  BoltPlaces places{Matrix3Xd(3, shape.point_count()),
                    std::vector<Eigen::Matrix3d>(shape.pieces().size(), Eigen::Matrix3d::Identity())};
  for (std::size_t piece = 0; piece < shape.pieces().size(); ++piece)
    for (std::size_t j = 0; j < shape.points(piece).size(); ++j)
      places.points.col(shape.first_point(piece) + static_cast<int>(j)) = shape.points(piece)[j];
  return places;
}

/// Pieces moved apart and turned, each still straight.
BoltPlaces moved(const BoltShape& shape) {
  BoltPlaces places = as_placed(shape);
  for (std::size_t piece = 0; piece < 3; ++piece) {
    const double sign = piece == 1 ? -1.0 : 0.5;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.2 * sign, Vector3d(1.0, 0.3 * sign, 0.2).normalized()).toRotationMatrix();
    for (int k = shape.first_point(piece); k < shape.first_point(piece + 1); ++k)
      places.points.col(k) = turn * places.points.col(k) + Vector3d(0.1 * sign, 0.05, 0.02 * sign);
    places.gradients[piece] = turn;
  }
  return places;
}

BoltPlaces rigidly_moved(BoltPlaces places) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.0, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  places.points = (turn * places.points).colwise() + Vector3d(5, -1, 2);
  for (Eigen::Matrix3d& gradient : places.gradients) gradient = turn * gradient;
  return places;
}

TEST(BoltKinematics, OnlyTheFirstJointIsDowelled) {
  const BoltShape shape = three_pieces();
  EXPECT_EQ(deformation_count(shape), 2 + 3 + 2 + 2);
  EXPECT_TRUE(bolt_deformation(shape, as_placed(shape)).isZero(1e-14));
}

TEST(BoltKinematics, RigidMotionIsNoDeformation) {
  const BoltShape shape = three_pieces();
  const BoltPlaces places = moved(shape);
  EXPECT_LE((bolt_deformation(shape, rigidly_moved(places)) - bolt_deformation(shape, places)).norm(), 1e-13);
}

TEST(BoltKinematics, RowsAreTheDerivative) {
  const BoltShape shape = three_pieces();
  const BoltPlaces places = moved(shape);
  const Eigen::VectorXd start = places.points.reshaped();
  const auto deformation = [&](const Eigen::VectorXd& x) {
    BoltPlaces at = places;
    at.points = x.reshaped(3, places.points.cols());
    return bolt_deformation(shape, at);
  };
  // The middle of the quadratic piece is on its chord, where its turning has no effect.
  test_support::expect_derivative(deformation, start, bolt_rows(shape, places), 1e-6, 1e-8);
}

TEST(BoltKinematics, ForcesHaveNeitherResultantNorTorque) {
  const BoltShape shape = three_pieces();
  const BoltPlaces places = moved(shape);
  const Eigen::MatrixXd rows = bolt_rows(shape, places);
  // The spin of n_1 and n_2 about the bar follows the block: shear forces have a torque about the bar alone.
  for (Eigen::Index row = 0; row < shape.point_count(); ++row) {
    const Matrix3Xd forces = rows.row(row).transpose().reshaped(3, places.points.cols());
    Vector3d torque = Vector3d::Zero();
    for (Eigen::Index k = 0; k < forces.cols(); ++k)
      torque += Vector3d(places.points.col(k)).cross(Vector3d(forces.col(k)));
    EXPECT_LE(forces.rowwise().sum().norm(), 1e-12);
    EXPECT_LE(torque.norm(), 1e-11);
  }
}

TEST(BoltKinematics, OfTwoEndsIsTheChangeOfTheirDistance) {
  BoltLaw law;
  law.anchorage = BoltAnchorage::ends;
  const BoltShape shape(law, {0, 0, 0}, {3, 0, 0}, {{0, 1, 0, 0}, {1, 1, 3, 3}}, 0.03);
  BoltPlaces places = as_placed(shape);
  places.points.col(1) = Vector3d(3, 4, 0);
  EXPECT_NEAR(bolt_deformation(shape, places)[0], 2.0, 1e-15);
  EXPECT_NEAR(
      (bolt_rows(shape, places) - (Eigen::MatrixXd(1, 6) << -0.6, -0.8, 0, 0.6, 0.8, 0).finished()).norm(),
      0.0, 1e-15);
}

}  // namespace
}  // namespace ashlar::bolt_kinematics_test

#include "geometry/exact/axis_rotation.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace ashlar::axis_rotation_test {
namespace {

TEST(AxisRotation, ExactAtRightAngles) {
  EXPECT_EQ(rotation_matrix(Vector3::UnitZ(), degree_turn(90.0)) * Vector3::UnitX(),
            Vector3(Vector3::UnitY()));
  EXPECT_EQ(rotation_matrix(Vector3::UnitX(), degree_turn(-270.0)) * Vector3::UnitY(),
            Vector3(Vector3::UnitZ()));
  EXPECT_EQ(rotation_matrix(Vector3(0, 0, 0)), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
}

// exp([w]x) by its series.
TEST(AxisRotation, IsTheExponentialOfTheVector) {
  const Vector3 rotation(0.3, -0.7, 0.5);
  Eigen::Matrix3d cross;
  cross << 0.0, -0.5, -0.7, 0.5, 0.0, -0.3, 0.7, 0.3, 0.0;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Identity(), term = sum;
  for (int n = 1; n < 30; ++n) {
    term = term * cross / n;
    sum += term;
  }
  EXPECT_LT((rotation_matrix(rotation) - sum).norm(), 1e-15);
}

TEST(AxisRotation, VectorsAreThoseOfTheirMatrices) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(-1.0, 1.0), angle(0.0, std::numbers::pi);
  for (int n = 0; n < 1000; ++n) {
    const Vector3 rotation =
        angle(random) * Vector3(share(random), share(random), share(random)).stableNormalized();
    ASSERT_LT((rotation_vector(rotation_matrix(rotation)) - rotation).norm(), 1e-14) << rotation.transpose();
  }
  EXPECT_EQ(rotation_vector(Eigen::Matrix3d::Identity()), Vector3(0, 0, 0));
  EXPECT_NEAR(rotation_vector(rotation_matrix(Vector3::UnitY(), degree_turn(180.0))).norm(), std::numbers::pi,
              1e-15);
  EXPECT_NEAR(rotation_vector(rotation_matrix(Vector3(1e-9, 0, 0))).x(), 1e-9, 1e-24);
}

}  // namespace
}  // namespace ashlar::axis_rotation_test

#include "solver/ground/ground_stress.hpp"

#include <gtest/gtest.h>

#include <array>

namespace ashlar::ground_stress_test {
namespace {

// 5 m below the surface with 20 kN/m^3: 100 kPa, and half of it across.
TEST(GroundStress, AtRestItIsTheWeightAboveAndK0TimesIt) {
  const StressField stress = stress_at_rest({.unit_weight = 2e4, .k0 = 0.5, .surface = 3.0});
  EXPECT_TRUE(stress({7, 8, -2}).isApprox(Eigen::Vector3d(-5e4, -5e4, -1e5).asDiagonal().toDenseMatrix()));
  EXPECT_TRUE(stress({0, 0, 3.5}).isZero(0.0));
}

TEST(GroundStress, HeightsAreAgainstGravity) {
  const StressField stress =
      stress_at_rest({.unit_weight = 2e4, .k0 = 2.0, .surface = 0.0, .up = -Vector3::UnitX()});
  EXPECT_TRUE(stress({1, 0, 0}).isApprox(Eigen::Vector3d(-2e4, -4e4, -4e4).asDiagonal().toDenseMatrix()));
  EXPECT_TRUE(stress({-1, 0, 0}).isZero(0.0));
}

// On a plane at 45 degrees to gravity: mean of both normal stresses, half of their difference as shear.
TEST(GroundStress, AnInclinedPlaneHasNormalStressAndShear) {
  const Eigen::Matrix3d stress = stress_at_rest({.unit_weight = 2e4, .k0 = 0.5})({0, 0, -5});
  const Vector3 normal = Vector3(1, 0, 1).normalized(), along = Vector3(1, 0, -1).normalized();
  EXPECT_NEAR(normal.dot(stress * normal), -7.5e4, 1e-9);
  EXPECT_NEAR(along.dot(stress * normal), 2.5e4, 1e-9);
}

TEST(GroundStress, ComponentsAreXxYyZzXyYzZx) {
  const std::array<double, 6> components = {1, 2, 3, 4, 5, 6};
  const Eigen::Matrix3d expected = (Eigen::Matrix3d() << 1, 4, 6, 4, 2, 5, 6, 5, 3).finished();
  EXPECT_EQ(symmetric_stress(components), expected);
}

}  // namespace
}  // namespace ashlar::ground_stress_test

#include "solver/state/slowest_vibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/simulations.hpp"

namespace ashlar::slowest_vibration_test {
namespace {

using test_support::block_of;

TEST(SlowestVibration, ACubeOfOrderOneShearsAtFirst) {
  // Affine shear gamma: 1/2 G gamma^2 V, 1/2 rho gamma_t^2 of x z: u = gamma z / 2 and w = gamma x / 2 have the kinetic
  // energy rho V gamma_t^2 a^2 / 48 together. w = sqrt(24 G / rho) / a.
  const Material stone{2500.0, 1e10, 0.25};
  const BlockModel cube(block_of("cube", Polyhedron(make_box({0, 0, 0}, {2, 2, 2})), stone, 1));
  const double shear = 1e10 / 2.5;
  EXPECT_NEAR(slowest_vibration(cube), std::sqrt(24.0 * shear / 2500.0) / 2.0,
              1e-6 * slowest_vibration(cube));
}

TEST(SlowestVibration, ACantileverBendsAtFirst) {
  // Euler and Bernoulli: 1.8751^2 sqrt(E I / (rho A)) / L^2, less some percent for shear.
  const Material stone{2500.0, 1e10, 0.0};
  BlockDefinition beam = block_of("beam", Polyhedron(make_box({0, 0, 0}, {10, 1, 1})), stone, 5);
  beam.supports.push_back({FaceList{outer_faces(*beam.solid, {{0, 0, 0}, -Vector3::UnitX()})}});
  const double slender = 1.8751 * 1.8751 * std::sqrt(1e10 / (12.0 * 2500.0)) / 100.0;
  EXPECT_NEAR(slowest_vibration(BlockModel(std::move(beam))) / slender, 1.0, 0.03);
}

TEST(SlowestVibration, RigidAndFixedBlocksHaveNone) {
  const Material stone{2500.0, 1e10, 0.25};
  const BlockModel rigid(block_of("rigid", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), stone, 0));
  EXPECT_EQ(slowest_vibration(rigid), std::numeric_limits<double>::infinity());
  const BlockModel fixed(test_support::fixed_box({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(slowest_vibration(fixed), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace ashlar::slowest_vibration_test

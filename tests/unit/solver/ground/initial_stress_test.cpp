#include "solver/ground/initial_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "solver/ground/ground_stress.hpp"
#include "support/simulations.hpp"

namespace ashlar::initial_stress_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_static;
using test_support::same_law;

/// A cube of 2 m and 25 kN/m^3 on a fixed floor, in ground of the same weight up to a height, without stress across.
Simulation cube_in_ground(double surface, const JointLaw& law = {1e10, 4e9, 0.6, 0.0, 0.0, true}) {
  BlockDefinition cube = block_of("cube", Polyhedron(make_box({0, 0, 0}, {2, 2, 2})), {2500.0, 1e9, 0.25}, 2);
  cube.initial_stress = stress_at_rest({.unit_weight = 2.5e4, .k0 = 0.0, .surface = surface});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-9, -9, -1}, {9, 9, 0}));
  blocks.emplace_back(std::move(cube));
  SimulationSettings settings;
  settings.gravity = {0, 0, -10};
  return {std::move(blocks), {{}, {}}, same_law(law), settings};
}

// The floor has the weight of the cube: 2 m times 25 kN/m^3 over 4 m^2.
TEST(InitialStress, ContactsBeginWithItsForces) {
  Simulation simulation = cube_in_ground(2.0);
  const auto worst = simulation.start_stressed();
  ASSERT_TRUE(worst);
  EXPECT_EQ(worst->block, 1);
  EXPECT_LT(worst->share, 1e-9);
  EXPECT_FALSE(worst->is_notable());
  EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  EXPECT_NEAR((place_of(simulation, 1, {1, 1, 2}) - Vector3(1, 1, 2)).norm(), 0.0, 1e-9);
}

// 50 kPa close a joint of 1 GPa/m and 0.1 mm by a third of that.
TEST(InitialStress, ContactsThatStiffenBeginWithItsForcesAndTheirEnergy) {
  JointLaw law{1e9, 4e8, 0.6, 0.0, 0.0, true};
  law.largest_closure = 1e-4;
  Simulation simulation = cube_in_ground(2.0, law);
  const auto worst = simulation.start_stressed();
  ASSERT_TRUE(worst);
  EXPECT_LT(worst->share, 1e-9);
  for (int k = 0; k < 20; ++k) ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
  EXPECT_NEAR((place_of(simulation, 1, {1, 1, 2}) - Vector3(1, 1, 2)).norm(), 0.0, 1e-9);
  const double held = 4.0 * 1e9 * 1e-8 * (std::log(1.5) - 1.0 / 3.0);
  EXPECT_NEAR(simulation.ledger().contact, held, 1e-6 * held);
}

// Stress on the floor of 4 m of ground, 16 m^3, against 8 m^3 of weight: 8 of 24 m^3 are missing.
TEST(InitialStress, AMissingWeightIsAnImbalance) {
  const auto worst = cube_in_ground(4.0).start_stressed();
  ASSERT_TRUE(worst);
  EXPECT_EQ(worst->block, 1);
  EXPECT_NEAR(worst->force, 8.0 * 2.5e4, 1e-3);
  EXPECT_NEAR(worst->share, 1.0 / 3.0, 1e-9);
  EXPECT_TRUE(worst->is_notable());
}

// Above the surface there is no stress: the floor begins without force under the cube's weight.
TEST(InitialStress, GroundWithoutStressTransmitsNothing) {
  const auto worst = cube_in_ground(0.0).start_stressed();
  ASSERT_TRUE(worst);
  EXPECT_NEAR(worst->force, 8.0 * 2.5e4, 1e-3);
  EXPECT_NEAR(worst->share, 1.0, 1e-9);
}

TEST(InitialStress, AHundredthOfTheForcesIsNotable) {
  EXPECT_FALSE((StressImbalance{0, 1.0, 0.0099}).is_notable());
  EXPECT_TRUE((StressImbalance{0, 1.0, 0.01}).is_notable());
}

}  // namespace
}  // namespace ashlar::initial_stress_test

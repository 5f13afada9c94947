// Contacts over many steps: no creep, no losses, forces add up, no energy is created.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/simulations.hpp"

namespace ashlar::contact_history_test {
namespace {

using test_support::block_of;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;
using test_support::tilted_box;

BlockDefinition fixed_block(Polyhedron solid) {
  BlockDefinition block = block_of("base", std::move(solid), {2500, 1e9, 0.2}, 1);
  block.fixed = true;
  return block;
}

struct Stack {
  SimulationSettings settings;
  std::vector<BlockModel> blocks;
  std::vector<InitialMotion> motions;
  void add(BlockDefinition block, const InitialMotion& motion = {}) {
    blocks.emplace_back(std::move(block));
    motions.push_back(motion);
  }
  Simulation simulation(const JointLaw& law) {
    return Simulation(std::move(blocks), std::move(motions), same_law(law), settings);
  }
};

/// A block of an order on an incline of 30 degrees whose friction angle is 31, released without strain.
Simulation block_on_incline(int order, bool augmented) {
  Stack stack;
  stack.settings.time_step = 5e-3;
  stack.settings.augmented = augmented;
  stack.settings.search.chord_tolerance = 1e-3;
  stack.settings.search.subdivisions = 0;
  stack.add(fixed_block(tilted_box({-3, -2, -1}, {3, 2, 0}, 30.0)));
  stack.add(block_of("block", tilted_box({-0.5, -0.4, 0}, {0.5, 0.4, 0.6}, 30.0), {2500, 1e8, 0.2}, order));
  return stack.simulation({1e10, 5e9, std::tan(31.0 * std::numbers::pi / 180.0), 0.0, 0.0, true});
}

// Springs at the corners carry a soft cube, whose lower face bulges into the floor between them, is divided
// when it does, and has other contact points then.
TEST(ContactHistory, ASoftCubeOnPointSpringsDoesNotSink) {
  for (const int order : {2, 3}) {
    Stack stack;
    stack.settings.area_springs = false;
    stack.settings.search.subdivisions = 0;
    stack.settings.search.chord_tolerance = 5e-3;
    stack.add(fixed_block(Polyhedron(make_box({-2, -2, -1}, {2, 2, 0}))));
    stack.add(
        block_of("cube", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 1})), {2500, 1e7, 0.2}, order));
    Simulation simulation = stack.simulation({1e8, 5e7, std::tan(std::numbers::pi / 6), 0.0, 0.0, false});
    ASSERT_TRUE(run_until(simulation, 1.0)) << order;
    // m g / (4 kn) = 6.1e-5 m at rest, twice that when released suddenly.
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        const double sunk = -place_of(simulation, 1, {x, y, 0}).z();
        EXPECT_GT(sunk, 0.0) << order;
        EXPECT_LT(sunk, 2.5e-4) << order;
      }
    }
  }
}

// Faces that fit exactly and curve: corners of their sub-faces come and go with the last bits.
TEST(ContactHistory, StacksOfCurvedBlocksStandOnPointSprings) {
  for (const int order : {2, 4}) {
    Stack stack;
    stack.settings.area_springs = false;
    stack.add(fixed_block(Polyhedron(make_box({-3, -3, -1}, {3, 3, 0}))));
    for (const double z : {0.0, 1.0})
      stack.add(block_of("cube", Polyhedron(make_box({-0.5, -0.5, z}, {0.5, 0.5, z + 1})), {2500, 1e10, 0.2},
                         order));
    Simulation simulation = stack.simulation({2e11, 1e11, std::tan(std::numbers::pi / 6), 0.0, 0.0, false});
    ASSERT_TRUE(run_until(simulation, 0.05)) << order;
    EXPECT_TRUE(simulation.rejections().empty()) << order;
    // Less than ten times the effect of its own weight, 5e4 Pa over 2 m.
    EXPECT_LT((place_of(simulation, 2, {0.5, 0.5, 2.0}) - Vector3(0.5, 0.5, 2.0)).norm(), 1e-4) << order;
  }
}

// Steps as long as the springs' own period: forces that are means over a step must not do work of their own.
TEST(ContactHistory, ATowerStandsWithAverageAcceleration) {
  for (const bool augmented : {false, true}) {
    Stack stack;
    stack.settings.integrator = Integrator::average_acceleration;
    stack.settings.area_springs = false;
    stack.settings.augmented = augmented;
    stack.add(fixed_block(Polyhedron(make_box({-2, -2, -1}, {2, 2, 0}))));
    for (const double z : {0.0, 1.0, 2.0})
      stack.add(
          block_of("cube", Polyhedron(make_box({-0.5, -0.5, z}, {0.5, 0.5, z + 1})), {2500, 1e10, 0.2}, 1));
    Simulation simulation = stack.simulation({2e11, 1e11, std::tan(std::numbers::pi / 6), 0.0, 0.0, false});
    ASSERT_TRUE(run_until(simulation, 0.3)) << augmented;
    // Its compression under its own weight is less than 1e-5 m, twice that when released suddenly.
    EXPECT_LT((place_of(simulation, 3, {0.5, 0.5, 3.0}) - Vector3(0.5, 0.5, 3.0)).norm(), 4e-5) << augmented;
  }
}

// A detection distance is how far gaps are looked for: it is not how deep blocks may be in each other.
TEST(ContactHistory, ALargeDetectionDistanceChangesNothing) {
  std::vector<double> heights;
  for (const double distance : {1e-3, 3.0}) {
    Stack stack;
    stack.settings.contact_distance = distance;
    stack.add(fixed_block(Polyhedron(make_box({-2, -2, -1}, {2, 2, 0}))));
    for (const double z : {0.005, 1.01})
      stack.add(
          block_of("cube", Polyhedron(make_box({-0.5, -0.5, z}, {0.5, 0.5, z + 1})), {2500, 1e9, 0.2}, 1));
    Simulation simulation = stack.simulation({1e10, 5e9, 0.5, 0.0, 0.0, true});
    ASSERT_TRUE(run_until(simulation, 0.2));
    heights.push_back(place_of(simulation, 2, {0, 0, 2.01}).z());
  }
  EXPECT_NEAR(heights[0], 2.0, 1e-4);
  EXPECT_NEAR(heights[1], heights[0], 1e-6);
}

TEST(ContactHistory, ABlockOnAnInclineDoesNotCreep) {
  for (const int order : {1, 2}) {
    Simulation simulation = block_on_incline(order, false);
    ASSERT_TRUE(run_until(simulation, 2.0));
    const Vector3 point(0.1, 0.1, 0.3);
    const Vector3 at_rest = place_of(simulation, 1, point);
    ASSERT_TRUE(run_until(simulation, 10.0));
    EXPECT_LT((place_of(simulation, 1, point) - at_rest).norm(), 1e-9) << order;
    EXPECT_TRUE(simulation.rejections().empty());
  }
}

TEST(ContactHistory, MultipliersHoldABlockWhateverTheSprings) {
  // Springs so soft that the block would sink by rho g h / kn = 0.15 m.
  for (const double stiffness : {1e5, 1e10}) {
    Stack stack;
    stack.settings.time_step = 5e-3;
    stack.settings.augmented = true;
    stack.settings.multipliers.penetration_tolerance = 1e-8;
    stack.add(fixed_block(Polyhedron(make_box({-3, -2, -1}, {3, 2, 0}))));
    stack.add(block_of("block", Polyhedron(make_box({-0.5, -0.4, 0}, {0.5, 0.4, 0.6})), {2500, 1e8, 0.2}, 1));
    Simulation simulation = stack.simulation({stiffness, stiffness, 0.5, 0.0, 0.0, true});
    ASSERT_TRUE(run_until(simulation, 0.5));
    EXPECT_LE(simulation.largest_penetration(), 1e-8) << stiffness;
    double force = 0.0;
    for (const PairRecord& pair : simulation.contacts()) {
      for (std::size_t k = 0; k < pair.points.size(); ++k)
        force += std::abs(pair.responses[k].force[0] * pair.points[k].normal.z());
    }
    EXPECT_NEAR(force, 2500.0 * 9.81 * 0.48, 1e-3 * 2500.0 * 9.81 * 0.48);
  }
}

TEST(ContactHistory, MultipliersHoldABlockOnAnIncline) {
  Simulation simulation = block_on_incline(1, true);
  const Vector3 point(0.1, 0.1, 0.3);
  ASSERT_TRUE(run_until(simulation, 1.0));
  const Vector3 at_rest = place_of(simulation, 1, point);
  ASSERT_TRUE(run_until(simulation, 3.0));
  EXPECT_LT((place_of(simulation, 1, point) - at_rest).norm(), 1e-6);
}

TEST(ContactHistory, ForcesAreTheChangesOfMomentum) {
  // The dda step: M (v' - v)/dt = m g + contact forces at its end.
  Stack stack;
  stack.settings.time_step = 1e-3;
  stack.add(fixed_block(Polyhedron(make_box({-3, -3, -1}, {3, 3, 0}))));
  InitialMotion thrown;
  thrown.velocity = {0.5, 0.2, -1.0};
  stack.add(block_of("lower", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500, 1e9, 0.2}, 1));
  stack.add(block_of("upper", tilted_box({0.2, 0.1, 1.05}, {0.9, 0.8, 1.6}, 3.0), {2500, 1e9, 0.2}, 2),
            thrown);
  Simulation simulation = stack.simulation({1e10, 5e9, 0.5, 0.0, 0.0, true});
  double most = 0.0;
  while (!simulation.reached(0.3)) {
    std::vector<Vector3> before;
    for (int k = 1; k < 3; ++k)
      before.push_back(simulation.blocks()[static_cast<std::size_t>(k)].momentum(
          simulation.states()[static_cast<std::size_t>(k)]));
    ASSERT_EQ(simulation.step(0.3), StepStatus::accepted);
    for (int k = 1; k < 3; ++k) {
      const BlockModel& block = simulation.blocks()[static_cast<std::size_t>(k)];
      Vector3 force = block.mass() * Vector3(0, 0, -9.81);
      for (const PairRecord& pair : simulation.contacts()) {
        if (pair.a == k) force += force_on_a(pair);
        if (pair.b == k) force -= force_on_a(pair);
      }
      const Vector3 change = block.momentum(simulation.states()[static_cast<std::size_t>(k)]) -
                             before[static_cast<std::size_t>(k - 1)];
      most = std::max(most, force.norm());
      EXPECT_LT((change - simulation.report().step * force).norm(), 1e-9 * simulation.report().step * most);
    }
  }
}

TEST(ContactHistory, ContactsFoundAnewNeverBringEnergyIn) {
  // Face, edge and vertex contacts follow each other, each with another area.
  for (const double turn : {-3.0, 2.0, 5.0, 11.0}) {
    Stack stack;
    stack.settings.time_step = 1e-3;
    stack.add(fixed_block(Polyhedron(make_box({-8, -8, -1}, {8, 8, 0}))));
    InitialMotion thrown;
    thrown.velocity = {2.0, 0.3, 0.0};
    thrown.angular_velocity = {0.4, turn, -0.3};
    stack.add(block_of("stone", tilted_box({-0.5, -0.4, 0.8}, {0.5, 0.4, 1.4}, 20.0), {2500, 1e8, 0.2}, 1),
              thrown);
    Simulation simulation = stack.simulation({2e9, 1e9, 0.5, 0.0, 0.0, true});
    const auto energy = [&] {
      const Ledger& ledger = simulation.ledger();
      return ledger.kinetic + ledger.elastic + ledger.gravity + ledger.contact;
    };
    double last = energy();
    while (!simulation.reached(1.5)) {
      ASSERT_EQ(simulation.step(1.5), StepStatus::accepted);
      EXPECT_LE(energy(), last + 1e-10 * simulation.largest_energy()) << turn << " at " << simulation.time();
      last = energy();
    }
    EXPECT_LT(simulation.ledger().redetection_gained, 1e-12 * simulation.largest_energy()) << turn;
    EXPECT_GT(simulation.ledger().redetection_lost, 0.0) << turn;
    EXPECT_LT(simulation.largest_step_residual(), 1e-8 * simulation.largest_energy()) << turn;
  }
}

}  // namespace
}  // namespace ashlar::contact_history_test

// Joints with a coefficient of restitution (solver/step/impact/restitution.hpp). Heights of rebounds: `ashlar verify`.
#include "solver/step/impact/restitution.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::restitution_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;

const Material stone{2500.0, 1e10, 0.2};

struct Setting {
  double restitution;
  bool multipliers = false;
  double gravity = 9.81;
  int threads = 1;
};

SimulationSettings settings_of(const Setting& setting) {
  SimulationSettings settings;
  settings.gravity = Vector3(0, 0, -setting.gravity);
  settings.time_step = 1e-3;
  settings.contact_distance = 2e-4;
  settings.augmented = setting.multipliers;
  settings.threads = setting.threads;
  settings.rest.sleeps = false;
  return settings;
}

JointLaw law_of(const Setting& setting) {
  JointLaw law{1e11, 5e10, 0.3, 0.0, 0.0, true};
  law.rigid = true;
  law.restitution = setting.restitution;
  return law;
}

BlockDefinition cube(const std::string& name, double bottom, int order) {
  return block_of(name, Polyhedron(make_box({-0.1, -0.1, bottom}, {0.1, 0.1, bottom + 0.2})), stone, order);
}

Simulation dropped(const Setting& setting, double drop, int order = 1) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-1, -1, -1}, {1, 1, 0}));
  blocks.emplace_back(cube("cube", drop, order));
  return {std::move(blocks), {{}, {}}, same_law(law_of(setting)), settings_of(setting)};
}

double speed_up(const Simulation& simulation, int block) {
  const auto k = static_cast<std::size_t>(block);
  return simulation.states()[k].velocity(0, 2) / std::sqrt(simulation.blocks()[k].basis().volume());
}

TEST(Restitution, ABlockAtRestStaysAtRestWithoutImpacts) {
  for (const bool multipliers : {false, true}) {
    Simulation simulation = dropped({1.0, multipliers}, 0.0, 0);
    ASSERT_TRUE(run_until(simulation, 0.2));
    EXPECT_EQ(simulation.steps(), 200) << "no step was cut";
    EXPECT_LT(std::abs(place_of(simulation, 1, {0, 0, 0}).z()), 1e-6);
  }
}

TEST(Restitution, ARestingStackIsNotShakenAndTransmitsTheImpact) {
  // The third cube falls on two that rest: it parts with e, they do not enter the floor, and energy falls.
  for (const bool multipliers : {false, true}) {
    const Setting setting{0.5, multipliers};
    std::vector<BlockModel> blocks;
    blocks.emplace_back(fixed_box({-1, -1, -1}, {1, 1, 0}));
    blocks.emplace_back(cube("lower", 0.0, 0));
    blocks.emplace_back(cube("upper", 0.2, 0));
    blocks.emplace_back(cube("falling", 0.45, 0));
    Simulation simulation(std::move(blocks), {{}, {}, {}, {}}, same_law(law_of(setting)),
                          settings_of(setting));
    double before = 0.0;
    while (speed_up(simulation, 3) <= 0.0) {
      before = speed_up(simulation, 3);
      ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
      ASSERT_LT(simulation.time(), 0.2);
    }
    EXPECT_NEAR(before, -std::sqrt(2.0 * 9.81 * 0.05), 0.011);
    EXPECT_NEAR(speed_up(simulation, 3), 0.5 * std::sqrt(2.0 * 9.81 * 0.05), 0.011);
    EXPECT_LT(std::abs(speed_up(simulation, 2)), 1e-2);
    EXPECT_LT(std::abs(place_of(simulation, 1, {0, 0, 0}).z()), 1e-6);
    EXPECT_LT(simulation.ledger().redetection_gained, 1e-9 * simulation.largest_energy());
  }
}

TEST(Restitution, TiedBlocksReboundAsOne) {
  const Setting setting{0.5};
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-1, -1, -1}, {1, 1, 0}));
  blocks.emplace_back(cube("lower", 0.05, 1));
  blocks.emplace_back(cube("upper", 0.25, 1));
  Simulation simulation(std::move(blocks), {{}, {}, {}}, same_law(law_of(setting)), settings_of(setting),
                        {{1, 2, 1e15}});
  const double fallen = std::sqrt(0.1 / 9.81);
  ASSERT_TRUE(run_until(simulation, fallen + 0.01));
  const double speed = 0.5 * std::sqrt(2.0 * 9.81 * 0.05) - 9.81 * 0.01;
  for (const int block : {1, 2}) EXPECT_NEAR(speed_up(simulation, block), speed, 2e-3);
}

TEST(Restitution, ACubeThatLandsOnAnEdgeTurnsAndGainsNoEnergy) {
  for (const bool multipliers : {false, true}) {
    const Setting setting{0.8, multipliers};
    std::vector<BlockModel> blocks;
    blocks.emplace_back(fixed_box({-1, -1, -1}, {1, 1, 0}));
    blocks.emplace_back(
        block_of("cube",
                 test_support::turned(Polyhedron(make_box({-0.1, -0.1, 0.1}, {0.1, 0.1, 0.3})),
                                      Eigen::AngleAxisd(0.3, Vector3(1, 2, 0).normalized()), {0, 0, 0.2}),
                 stone, 1));
    Simulation simulation(std::move(blocks), {{}, {}}, same_law(law_of(setting)), settings_of(setting));
    double last = std::numeric_limits<double>::infinity();
    while (!simulation.reached(1.0)) {
      ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
      const Ledger& ledger = simulation.ledger();
      const double energy = ledger.kinetic + ledger.elastic + ledger.gravity + ledger.contact;
      EXPECT_LT(energy - last, 1e-5 * simulation.largest_energy()) << simulation.time();
      last = energy;
    }
    EXPECT_GT(simulation.ledger().damping, 0.0);
  }
}

TEST(Restitution, ARunThatIsResumedBetweenTouchAndReboundTakesTheSameSteps) {
  for (const int threads : {1, 2}) {
    Simulation straight = dropped({0.7}, 0.05);
    Simulation resumed = dropped({0.7, false, 9.81, threads}, 0.05);
    bool touched = false;
    while (!straight.reached(0.3)) {
      if (!touched && place_of(straight, 1, {0, 0, 0.05}).z() < 3e-6) {
        touched = true;
        resumed.restore(snapshot_from_bytes(to_bytes(straight.snapshot())));
      }
      ASSERT_EQ(straight.step(0.3), StepStatus::accepted);
      if (touched) {
        ASSERT_EQ(resumed.step(0.3), StepStatus::accepted);
      }
    }
    ASSERT_TRUE(touched);
    EXPECT_EQ(straight.states()[1].position, resumed.states()[1].position);
    EXPECT_EQ(straight.states()[1].velocity, resumed.states()[1].velocity);
    EXPECT_EQ(straight.ledger().damping, resumed.ledger().damping);
  }
}

}  // namespace
}  // namespace ashlar::restitution_test

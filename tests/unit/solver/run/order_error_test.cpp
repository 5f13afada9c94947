#include "solver/run/order_error.hpp"

#include <gtest/gtest.h>

#include "solver/run/order_error_work.hpp"
#include "support/simulations.hpp"

namespace ashlar::order_error_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::run_static;
using test_support::run_until;
using test_support::same_law;

const Material bar{2500.0, 1e7, 0.0};
constexpr double height = 2.0, area = 0.5, gravity = 9.81;
/// Under its own weight, with s = rho g (h - z): the integral of s^2 / 2E.
const double exact =
    bar.density * bar.density * gravity * gravity * height * height * height * area / (6 * 1e7);

BlockDefinition bar_of(int order) {
  return block_of("bar", Polyhedron(make_box({0, 0, 0}, {area, 1, height})), bar, order);
}

Simulation hanging(int order) {
  BlockDefinition block = bar_of(order);
  block.supports.push_back({Plane{{0, 0, height}, Vector3::UnitZ()}});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(block));
  Simulation simulation(std::move(blocks), {{}}, same_law({1e9, 1e9, 0.5}), SimulationSettings{});
  (void)simulation.settle_supported_blocks();
  return simulation;
}

// The mean stress rho g h / 2 has 3/4 of the energy; order 2 has all of it.
TEST(OrderError, IsTheEnergyThatOrderOneLacksUnderWeight) {
  const auto errors = order_errors(hanging(1));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_NEAR(errors[0].energy / exact, 0.75, 1e-12);
  EXPECT_NEAR(errors[0].missing_energy / exact, 0.25, 1e-9);
  EXPECT_NEAR(errors[0].relative(), 0.5, 1e-9);
  EXPECT_NEAR(relative_error(errors), 0.5, 1e-9);
  for (const int order : {2, 3}) EXPECT_EQ(order_errors(hanging(order))[0].missing_energy, 0.0) << order;
}

// The same bar on a base, by contact.
TEST(OrderError, CountsContactForces) {
  for (const bool augmented : {false, true}) {
    for (const int order : {1, 2}) {
      std::vector<BlockModel> blocks;
      blocks.emplace_back(fixed_box({-1, -1, -1}, {2, 2, 0}));
      blocks.emplace_back(bar_of(order));
      SimulationSettings settings;
      settings.augmented = augmented;
      Simulation simulation(std::move(blocks), {{}, {}}, same_law({1e11, 1e11, 0.5, 0.0, 0.0, true}),
                            settings);
      ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
      const auto errors = order_errors(simulation);
      ASSERT_EQ(errors.size(), 1U) << "the base is fixed";
      EXPECT_EQ(errors[0].block, 1);
      EXPECT_NEAR(errors[0].missing_energy / exact, order == 1 ? 0.25 : 0.0, 1e-3) << order << augmented;
    }
  }
}

// Halves of the hanging bar, tied. Order 1 has their mean stresses rho g h / 4 and 3 rho g h / 4: of the energy of the
// whole, 8/3 in units of that of rho g h / 2 all over a half, each lacks 1/12.
TEST(OrderError, CountsForcesOfTies) {
  for (const int order : {1, 2}) {
    std::vector<BlockModel> blocks;
    for (const double low : {0.0, height / 2.0}) {
      BlockDefinition block =
          block_of("half", Polyhedron(make_box({0, 0, low}, {area, 1, low + height / 2.0})), bar, order);
      if (low > 0.0) block.supports.push_back({Plane{{0, 0, height}, Vector3::UnitZ()}});
      blocks.emplace_back(std::move(block));
    }
    Simulation simulation(std::move(blocks), {{}, {}}, same_law({1e9, 1e9, 0.5}), SimulationSettings{},
                          {{0, 1, 1e12}});
    ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
    const auto errors = order_errors(simulation);
    ASSERT_EQ(errors.size(), 2U);
    for (const OrderError& error : errors)
      EXPECT_NEAR(error.missing_energy / exact, order == 1 ? 1.0 / 12.0 / (8.0 / 3.0) : 0.0, 1e-5) << order;
    EXPECT_NEAR(relative_error(errors), order == 1 ? 0.25 : 0.0, 1e-4) << order;
  }
}

// Far from the origin the gap of a tie is the difference of large places.
TEST(OrderError, RoundingOfTiesIsNone) {
  std::vector<BlockModel> blocks;
  for (const double low : {0.0, 1.0 / 3.0})
    blocks.emplace_back(block_of(
        "part", Polyhedron(make_box({1e3, 7e2, low}, {1e3 + 0.1, 7e2 + 0.3, low + 1.0 / 3.0})), bar, 2));
  Simulation simulation(std::move(blocks), {{{1, 0, 3}, {0, 0, 0}}, {{1, 0, 3}, {0, 0, 0}}},
                        same_law({1e9, 1e9, 0.5}), SimulationSettings{}, {{0, 1, 3e12}});
  ASSERT_TRUE(run_until(simulation, 0.01));
  const auto errors = order_errors(simulation);
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_EQ(relative_error(errors), 0.0);
}

TEST(OrderError, WithoutDeformationThereIsNone) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(bar_of(2));
  Simulation simulation(std::move(blocks), {{{1, 0, 3}, {0, 0, 0}}}, same_law({1e9, 1e9, 0.5}),
                        SimulationSettings{});
  ASSERT_TRUE(run_until(simulation, 0.01));
  EXPECT_EQ(relative_error(order_errors(simulation)), 0.0);
  EXPECT_EQ(relative_error({}), 0.0);
}

// Gravity acts on the mean alone, and nothing else acts: no work is needed to know that there is no error.
TEST(OrderError, AFreeBlockNeedsNoModelOfHigherOrder) {
  for (const int order : {1, 3}) {
    std::vector<BlockModel> blocks;
    blocks.emplace_back(bar_of(order));
    Simulation simulation(std::move(blocks), {{{1, 0, 3}, {0, 0, 0}}}, same_law({1e9, 1e9, 0.5}),
                          SimulationSettings{});
    for (const double time : {0.0, 0.01}) {
      ASSERT_TRUE(run_until(simulation, time));
      const OrderErrors found = order_errors_within(simulation, 0.0);
      EXPECT_EQ(found.blocks, 1);
      ASSERT_EQ(found.errors.size(), 1U) << order << ' ' << time;
      EXPECT_EQ(found.errors[0].block, 0);
      EXPECT_EQ(found.errors[0].missing_energy, 0.0);
    }
  }
}

/// Two bars that hang side by side, the second of twice the density.
Simulation two_hanging() {
  std::vector<BlockModel> blocks;
  for (const int k : {0, 1}) {
    BlockDefinition block =
        block_of("bar", Polyhedron(make_box({8.0 * k, 0, 0}, {8.0 * k + area, 1, height})), bar, 1);
    block.material.density *= 1 + k;
    block.supports.push_back({Plane{{0, 0, height}, Vector3::UnitZ()}});
    blocks.emplace_back(std::move(block));
  }
  Simulation simulation(std::move(blocks), {{}, {}}, same_law({1e9, 1e9, 0.5}), SimulationSettings{});
  (void)simulation.settle_supported_blocks();
  return simulation;
}

TEST(OrderError, LargestForcesComeFirstWithinALimitOfWork) {
  const Simulation simulation = two_hanging();
  const std::vector<OrderError> all = order_errors(simulation);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NEAR(all[0].missing_energy / exact, 0.25, 1e-9);
  EXPECT_NEAR(all[1].missing_energy / exact, 4 * 0.25, 1e-9) << "squares of stresses";
  // Order 3 of a box with 12 triangles: 20 * 20^3 + 50 * 12 * 20^2 for the model, 6 * 20^3 for the solution.
  constexpr double of_one = 400000.0 + 48000.0;
  for (const auto& [work, count] :
       {std::pair{0.0, 0U}, {0.9 * of_one, 0U}, {1.9 * of_one, 1U}, {2.1 * of_one, 2U}}) {
    const OrderErrors some = order_errors_within(simulation, work);
    EXPECT_EQ(some.blocks, 2);
    ASSERT_EQ(some.errors.size(), count) << work;
    if (count != 1) continue;
    EXPECT_EQ(some.errors[0].block, 1);
    EXPECT_EQ(some.errors[0].missing_energy, all[1].missing_energy);
    EXPECT_EQ(some.errors[0].energy, all[1].energy);
  }
}

// Two bars on a base, with the same data or each with its own.
TEST(OrderError, EqualBlocksHaveTheBitsOfSingleOnes) {
  std::vector<std::vector<OrderError>> errors;
  for (const bool shared : {false, true}) {
    BlockPartsLibrary library;
    std::vector<BlockModel> blocks;
    blocks.emplace_back(fixed_box({-1, -1, -1}, {10, 2, 0}));
    for (const double x : {0.0, 8.0}) {
      BlockDefinition block = block_of("bar", Polyhedron(make_box({x, 0, 0}, {x + area, 1, height})), bar, 1);
      shared ? (void)blocks.emplace_back(std::move(block), library)
             : (void)blocks.emplace_back(std::move(block));
    }
    EXPECT_EQ(blocks[1].parts() == blocks[2].parts(), shared);
    Simulation simulation(std::move(blocks), {{}, {}, {}}, same_law({1e11, 1e11, 0.5, 0.0, 0.0, true}),
                          SimulationSettings{});
    ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
    errors.push_back(order_errors(simulation));
    ASSERT_EQ(errors.back().size(), 2U);
  }
  for (const std::size_t k : {0U, 1U}) {
    EXPECT_NEAR(errors[1][k].missing_energy / exact, 0.25, 1e-3);
    EXPECT_EQ(errors[1][k].missing_energy, errors[0][k].missing_energy);
    EXPECT_EQ(errors[1][k].energy, errors[0][k].energy);
  }
}

TEST(OrderError, RigidBlocksAndThoseOfTheLargestOrderHaveNone) {
  for (const int order : {0, PolynomialBasis::max_order}) {
    std::vector<BlockModel> blocks;
    blocks.emplace_back(bar_of(order));
    const Simulation simulation(std::move(blocks), {{}}, same_law({1e9, 1e9, 0.5}), SimulationSettings{});
    EXPECT_TRUE(order_errors(simulation).empty()) << order;
  }
}

// Stress of a spinning bar is even along it: order 1 has its mean, order 2 adds nothing.
TEST(OrderError, SeesTheNextOrderButOne) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("bar", Polyhedron(make_box({-1, -0.1, -0.1}, {1, 0.1, 0.1})), bar, 1));
  SimulationSettings settings;
  settings.gravity.setZero();
  // Half a vibration of the bar along its length, which takes 4 L sqrt(rho / E) / pi or so: the stress is large.
  settings.time_step = 1e-3;
  Simulation simulation(std::move(blocks), {{{0, 0, 0}, {0, 0, 5}}}, same_law({1e9, 1e9, 0.5}), settings);
  ASSERT_TRUE(run_until(simulation, 0.03));
  EXPECT_GT(relative_error(order_errors(simulation)), 0.1);
}

}  // namespace
}  // namespace ashlar::order_error_test

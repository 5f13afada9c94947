#include "solver/accuracy/order_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/simulations.hpp"

namespace ashlar::order_estimate_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::run_static;
using test_support::same_law;

/// Rounds of one block of the orders 1, 2, ... whose goal is 1 - error(order).
template <typename Error>
std::vector<AccuracyRound> rounds_to(int order, Error error) {
  std::vector<AccuracyRound> rounds;
  for (int n = 1; n <= order; ++n) {
    AccuracyRound round{{{1.0 - error(n)}}, {1.0}, {1.0}};
    round.orders = {n};
    round.of_changes = n > 2;
    rounds.push_back(round);
  }
  return rounds;
}

double cubic(int n) {
  return std::pow(n, -3.0);
}

double twentieth(int n) {
  return std::pow(0.05, n);
}

// 6^-3 - 8^-3 = 8^-3 ((8 / 6)^3 - 1): the estimate is the error.
TEST(OrderEstimate, IsTheErrorOfWhatFallsLikeTheCubeOfTheOrder) {
  for (const int order : {5, 6, 7, 8})
    EXPECT_NEAR(order_error_of(rounds_to(order, cubic), 0, {"goal", {1.0}}), cubic(order), 1e-12) << order;
}

// Changes of n^-1 over two orders: 1 / 24 = 1/6 - 1/8 and 1 / 12 = 1/4 - 1/6, half of it each time: as much is left.
TEST(OrderEstimate, AMeasuredRatioCountsIfItIsSlower) {
  const auto slow = [](int n) { return 1.0 / n; };
  EXPECT_NEAR(order_error_of(rounds_to(8, slow), 0, {"goal", {1.0}}), 1.0 / 24.0, 1e-12);
}

// Of the orders alone, without any: of a change of 0.05^2 of 0.05^6 a third of two thirds is left (least ratio).
TEST(OrderEstimate, WithoutOrdersARatioIsAtLeastAThird) {
  std::vector<AccuracyRound> rounds = rounds_to(6, twentieth);
  for (AccuracyRound& round : rounds) round.orders.clear();
  EXPECT_NEAR(order_error_of(rounds, 0, {"goal", {1.0}}), 0.5 * (twentieth(4) - twentieth(6)), 1e-15);
}

// 6^-3 at order 6 is 8^-3 at order 8.
TEST(OrderEstimate, TellsWhatTheHighestOrderWouldLeave) {
  const Goal goal{"goal", {1.0}};
  EXPECT_NEAR(slow_error_at(rounds_to(6, cubic), 0, goal, 8), cubic(8), 1e-12);
  EXPECT_EQ(slow_error_at(rounds_to(5, cubic), 0, goal, 8), 0.0) << "too early to tell";
  EXPECT_EQ(slow_error_at(rounds_to(6, twentieth), 0, goal, 8), 0.0) << "not slow";
}

TEST(OrderEstimate, LacksOfChangesSayNothingAboutTheNextOrders) {
  std::vector<AccuracyRound> rounds = rounds_to(2, cubic);
  rounds.back().missing_energy = {1e-4};
  EXPECT_NEAR(order_error_of(rounds, 0, {"goal", {1.0}}), std::sqrt(1e-4 / 1.0001), 1e-12);
  rounds.back().of_changes = true;
  EXPECT_TRUE(std::isinf(order_error_of(rounds, 0, {"goal", {1.0}})));
}

/// A bar of 1 m^2 and 2 m under its weight, without lateral strain, on a base.
Simulation standing(int order) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-1, -1, -1}, {2, 2, 0}));
  blocks.emplace_back(block_of("bar", Polyhedron(make_box({0, 0, 0}, {1, 1, 2})), {2500.0, 1e7, 0.0}, order));
  return {std::move(blocks), {{}, {}}, same_law({1e11, 1e11, 0.5, 0.0, 0.0, true}), SimulationSettings{}};
}

AccuracyRound round_of(const Simulation& simulation) {
  AccuracyRound round;
  round.orders = {0, simulation.blocks()[1].order()};
  round.missing_energy = {0.0, -1.0};
  for (std::size_t k = 0; k < 2; ++k) round.positions.push_back(simulation.states()[k].position);
  round.energies = {0.0, simulation.blocks()[1].elastic(simulation.states()[1].position).energy};
  return round;
}

// Stress rho g (h - z) has the energy (rho g)^2 h^3 / 6E per area, its mean rho g h / 2 of order 1 (rho g)^2 h^3 / 8E: a
// quarter is missing.
TEST(OrderEstimate, LacksOfChangesAreTheEnergyOfTheDifference) {
  std::vector<AccuracyRound> rounds;
  for (const int order : {1, 2}) {
    Simulation simulation = standing(order);
    ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
    rounds.push_back(round_of(simulation));
  }
  Simulation simulation = standing(3);
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  AccuracyRound now = round_of(simulation);
  take_missing_energy_of_changes(simulation, rounds, now);
  EXPECT_NEAR(now.missing_energy[1] / now.energies[1], 0.25, 1e-3);
  EXPECT_EQ(now.missing_energy[0], 0.0);
}

TEST(OrderEstimate, ABlockThatRoseByOneOrderKeepsTheLargerLack) {
  Simulation low = standing(2), high = standing(3);
  ASSERT_EQ(run_static(low, 1.0), StaticStatus::equilibrium);
  ASSERT_EQ(run_static(high, 1.0), StaticStatus::equilibrium);
  AccuracyRound now = round_of(high);
  now.missing_energy[1] = 7.0;
  take_missing_energy_of_changes(high, {round_of(low), round_of(low)}, now);
  EXPECT_EQ(now.missing_energy[1], 7.0);
  now.missing_energy[1] = -1.0;
  take_missing_energy_of_changes(high, {round_of(low), round_of(low)}, now);
  EXPECT_EQ(now.missing_energy[1], -1.0) << "not estimated";
}

}  // namespace
}  // namespace ashlar::order_estimate_test

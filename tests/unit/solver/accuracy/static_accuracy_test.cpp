#include "solver/accuracy/static_accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/simulations.hpp"

namespace ashlar::static_accuracy_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_static;
using test_support::same_law;

const std::function<bool()> always = [] { return true; };

const Material bar{2500.0, 1e7, 0.0};

/// A bar of 1 m^2 and 2 m on a base.
Simulation standing(int order) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-1, -1, -1}, {2, 2, 0}));
  blocks.emplace_back(block_of("bar", Polyhedron(make_box({0, 0, 0}, {1, 1, 2})), bar, order));
  return {std::move(blocks), {{}, {}}, same_law({1e11, 1e11, 0.5, 0.0, 0.0, true}), SimulationSettings{}};
}

/// Displacement of the middle of the bar.
std::vector<Goal> middle_of_bar(const Simulation& simulation) {
  const Vector3 middle(0.5, 0.5, 1.0);
  const Vector3 travel = place_of(simulation, 1, middle) - middle;
  return {{"middle", {travel.x(), travel.y(), travel.z()}}};
}

// Under its weight the middle sinks by 3/4 of rho g h^2 / 2E; order 1 has half of it at the middle, order 2 is exact.
TEST(StaticAccuracy, RaisesTheOrderOfABarUntilItIsExact) {
  Simulation simulation = standing(1);
  AccuracyRounds rounds;
  ASSERT_EQ(find_equilibrium(simulation, 1.0, {1e-3, {false, true}}, middle_of_bar, rounds, always),
            StaticStatus::equilibrium);
  const double exact = -0.75 * 2500.0 * 9.81 * 4.0 / 2.0 / 1e7;
  EXPECT_NEAR(middle_of_bar(simulation)[0].values[2] / exact, 1.0, 1e-3);
  EXPECT_GE(simulation.blocks()[1].order(), 2);
  EXPECT_LE(simulation.blocks()[1].order(), 4) << "two orders that change nothing are enough";
  const AccuracyEstimate estimate = accuracy_estimate(middle_of_bar(simulation), rounds);
  EXPECT_LE(estimate.order, 1e-3);
  EXPECT_EQ(estimate.sub_faces, 0.0);
}

// Held at four sides, a plate has no motion of an order below 4, x (1 - x) y (1 - y): nothing changes over three rounds.
TEST(StaticAccuracy, GoesOnWhereSupportsLeaveNoMotionToLowOrders) {
  const GoalValues middle = [](const Simulation& now) {
    return std::vector<Goal>{{"middle", {place_of(now, 0, {0.5, 0.5, 0.1}).z() - 0.1}}};
  };
  const auto plate = [](int order) {
    BlockDefinition block =
        block_of("plate", Polyhedron(make_box({0, 0, 0}, {1, 1, 0.2})), {2500.0, 1e9, 0.3}, order);
    for (int axis = 0; axis < 2; ++axis)
      for (const double side : {0.0, 1.0})
        block.supports.push_back({Plane{side * Vector3::Unit(axis), Vector3::Unit(axis)}});
    std::vector<BlockModel> blocks;
    blocks.emplace_back(std::move(block));
    return Simulation(std::move(blocks), {{}}, same_law({1e9, 1e9, 0.5}), SimulationSettings{});
  };
  Simulation simulation = plate(1);
  AccuracyRounds rounds;
  ASSERT_EQ(find_equilibrium(simulation, 1.0, {0.1, {true}}, middle, rounds, always),
            StaticStatus::equilibrium);
  EXPECT_GT(accuracy_estimate(middle(simulation), rounds).order, 0.0);
  Simulation fine = plate(8);
  ASSERT_EQ(run_static(fine, 1.0), StaticStatus::equilibrium);
  EXPECT_NEAR(middle(simulation)[0].values[0] / middle(fine)[0].values[0], 1.0, 0.1);
}

// Halves of such a plate, tied and held at three sides, have no motion below order 3.
TEST(StaticAccuracy, GoesOnWhereTiedBlocksHaveNoMotionYet) {
  const GoalValues middle = [](const Simulation& now) {
    return std::vector<Goal>{{"middle", {place_of(now, 0, {0.5, 0.5, 0.1}).z() - 0.1}}};
  };
  const auto halves = [](int order) {
    std::vector<BlockModel> blocks;
    for (const double side : {0.0, 0.5}) {
      BlockDefinition block = block_of("half", Polyhedron(make_box({side, 0, 0}, {side + 0.5, 1, 0.2})),
                                       {2500.0, 1e9, 0.3}, order);
      block.supports.push_back({Plane{{2.0 * side, 0, 0}, Vector3::UnitX()}});
      for (const double end : {0.0, 1.0}) block.supports.push_back({Plane{{0, end, 0}, Vector3::UnitY()}});
      blocks.emplace_back(std::move(block));
    }
    const std::vector<InitialMotion> at_rest(2);
    return Simulation(std::move(blocks), at_rest, same_law({1e9, 1e9, 0.5}), SimulationSettings{},
                      {{0, 1, 1e13}});
  };
  Simulation simulation = halves(1);
  AccuracyRounds rounds;
  ASSERT_EQ(find_equilibrium(simulation, 1.0, {0.1, {true, true}}, middle, rounds, always),
            StaticStatus::equilibrium);
  EXPECT_GT(accuracy_estimate(middle(simulation), rounds).order, 0.0);
  Simulation fine = halves(7);
  ASSERT_EQ(run_static(fine, 1.0), StaticStatus::equilibrium);
  EXPECT_NEAR(middle(simulation)[0].values[0] / middle(fine)[0].values[0], 1.0, 0.1);
}

TEST(StaticAccuracy, WithoutGoalsTheEnergyOfBlocksIsOne) {
  Simulation simulation = standing(1);
  AccuracyRounds rounds;
  const GoalValues none = [](const Simulation&) { return std::vector<Goal>(); };
  ASSERT_EQ(find_equilibrium(simulation, 1.0, {1e-2, {false, true}}, none, rounds, always),
            StaticStatus::equilibrium);
  EXPECT_EQ(simulation.blocks()[1].order(), 2);
  ASSERT_EQ(rounds.orders.size(), 2U);
  EXPECT_NEAR(rounds.orders[0].missing_energy[1] / rounds.orders[1].energies[1], 0.25, 1e-3);
  EXPECT_LE(accuracy_estimate({}, rounds).largest(), 1e-3);
}

TEST(StaticAccuracy, KeepsGivenOrdersAndSaysWhatTheyMiss) {
  Simulation simulation = standing(1);
  AccuracyRounds rounds;
  const GoalValues none = [](const Simulation&) { return std::vector<Goal>(); };
  ASSERT_EQ(find_equilibrium(simulation, 1.0, {1e-2, {false, false}}, none, rounds, always),
            StaticStatus::equilibrium);
  EXPECT_EQ(simulation.blocks()[1].order(), 1);
  EXPECT_NEAR(accuracy_estimate({}, rounds).order, 0.25, 1e-2);
}

TEST(StaticAccuracy, WithoutARoundNothingIsKnown) {
  const AccuracyEstimate estimate = accuracy_estimate({{"goal", {1.0}}}, {});
  EXPECT_TRUE(std::isinf(estimate.order));
  ASSERT_EQ(estimate.goals.size(), 1U);
  EXPECT_TRUE(std::isinf(estimate.goals[0]));
}

/// A ball of order 3 and 1 m that lies on a base.
Simulation ball(double chord_tolerance) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-2, -2, -1}, {2, 2, 0}));
  BlockDefinition block = block_of("ball", Polyhedron(make_sphere({0, 0, 1}, 1.0, 1)), {2500, 1e6, 0.3}, 3);
  block.supports.push_back({Vector3(0, 0, 1), {true, true, false}});
  blocks.emplace_back(std::move(block));
  SimulationSettings settings;
  settings.search.chord_tolerance = chord_tolerance;
  return {std::move(blocks), {{}, {}}, same_law({1e9, 1e9, 0.0, 0.0, 0.0, true}), settings};
}

// The chord tolerance becomes a quarter at least once, and the run on the coarse sub-faces differs as was estimated.
TEST(StaticAccuracy, DividesCurvedFacesInContact) {
  constexpr double coarse = 0.05;
  Simulation simulation = ball(coarse);
  const GoalValues sinking = [](const Simulation& now) {
    return std::vector<Goal>{{"middle", {place_of(now, 1, {0, 0, 1}).z() - 1.0}}};
  };
  AccuracyRounds rounds;
  ASSERT_EQ(find_equilibrium(simulation, 1.0, {1e-2, {false, false}, true}, sinking, rounds, always),
            StaticStatus::equilibrium);
  ASSERT_FALSE(rounds.sub_faces.empty());
  EXPECT_EQ(rounds.orders.size(), 1U);
  EXPECT_EQ(simulation.system().settings().search.chord_tolerance,
            coarse * std::pow(0.25, static_cast<double>(rounds.sub_faces.size())));
  EXPECT_LE(accuracy_estimate(sinking(simulation), rounds).sub_faces, 1e-2);
  Simulation fine = ball(simulation.system().settings().search.chord_tolerance / 16.0);
  ASSERT_EQ(run_static(fine, 1.0), StaticStatus::equilibrium);
  EXPECT_NEAR(sinking(simulation)[0].values[0] / sinking(fine)[0].values[0], 1.0, 1e-2);
}

TEST(StaticAccuracy, ChordAndStepAreAboveZero) {
  Simulation simulation = standing(1);
  EXPECT_THROW(simulation.set_chord_tolerance(0.0), std::invalid_argument);
  EXPECT_THROW(simulation.set_time_step(-1.0), std::invalid_argument);
}

TEST(StaticAccuracy, CanBeEnded) {
  Simulation simulation = standing(1);
  AccuracyRounds rounds;
  EXPECT_EQ(
      find_equilibrium(simulation, 1.0, {1e-2, {false, true}}, middle_of_bar, rounds, [] { return false; }),
      StaticStatus::balancing);
  EXPECT_TRUE(rounds.orders.empty());
}

// Two halves of the bar, tied. The top sinks by rho g h^2 / 2E.
TEST(StaticAccuracy, RaisesTheOrdersOfTiedBlocks) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-1, -1, -1}, {2, 2, 0}));
  blocks.emplace_back(block_of("low", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), bar, 1));
  blocks.emplace_back(block_of("high", Polyhedron(make_box({0, 0, 1}, {1, 1, 2})), bar, 1));
  Simulation simulation(std::move(blocks), {{}, {}, {}}, same_law({1e11, 1e11, 0.5, 0.0, 0.0, true}),
                        SimulationSettings{}, {{1, 2, 1e13}});
  const Vector3 top(0.5, 0.5, 2.0);
  const GoalValues goal = [&](const Simulation& now) {
    return std::vector<Goal>{{"top", {place_of(now, 2, top).z() - 2.0}}};
  };
  AccuracyRounds rounds;
  ASSERT_EQ(find_equilibrium(simulation, 1.0, {1e-3, {false, true, true}}, goal, rounds, always),
            StaticStatus::equilibrium);
  EXPECT_GE(simulation.blocks()[1].order(), 2);
  EXPECT_GE(simulation.blocks()[2].order(), 2);
  EXPECT_NEAR(goal(simulation)[0].values[0] / (-2500.0 * 9.81 * 4.0 / 2.0 / 1e7), 1.0, 1e-3);
  EXPECT_LE(accuracy_estimate(goal(simulation), rounds).order, 1e-3);
}

/// Rounds with these values of one goal. @param missing_energy of the only block, whose energy is 1 J
std::vector<AccuracyRound> rounds_of(const std::vector<double>& values, double missing_energy) {
  std::vector<AccuracyRound> rounds;
  for (const double value : values) rounds.push_back({{{value}}, {1.0}, {missing_energy}});
  return rounds;
}

// 1 - 0.7^k: 0.7^4 is left.
TEST(StaticAccuracy, EstimatesTheRestOfAGeometricSequence) {
  AccuracyRounds rounds;
  rounds.orders = rounds_of({0.0, 0.3, 0.51, 0.657, 0.7599}, 1.0);
  EXPECT_NEAR(accuracy_estimate({{"goal", {0.7599}}}, rounds).order, 0.2401 / 0.7599, 1e-12);
  EXPECT_NEAR(accuracy_estimate({{"goal", {0.7599}, 2.0}}, rounds).order, 0.2401 / 2.0, 1e-12)
      << "relative to the least value";
  rounds.orders = rounds_of({0.0, 0.3, 0.51, 0.657, 0.7599}, 1e-4);
  EXPECT_NEAR(accuracy_estimate({{"goal", {0.7599}}}, rounds).order, 1e-2, 1e-5)
      << "no more than in the norm of the energy";
}

// Odd orders change nothing in an even function: a pause is not the end.
TEST(StaticAccuracy, APauseIsNotTheEnd) {
  AccuracyRounds rounds;
  rounds.orders = rounds_of({0.0, 0.5, 0.5}, 1.0);
  EXPECT_GT(accuracy_estimate({{"goal", {0.5}}}, rounds).order, 0.05);
  rounds.orders = rounds_of({0.0, 0.5, 0.5, 0.5}, 1.0);
  EXPECT_LT(accuracy_estimate({{"goal", {0.5}}}, rounds).order, 1e-12);
}

// Gaps are proportional to the chord tolerance, of which a round leaves a quarter: a third of the change is left.
TEST(StaticAccuracy, EstimatesSubFacesFromTheLastRound) {
  AccuracyRounds rounds;
  rounds.orders = rounds_of({1.0}, 0.0);
  rounds.sub_faces = rounds_of({1.3, 1.36}, 0.0);
  const AccuracyEstimate estimate = accuracy_estimate({{"goal", {1.36}}}, rounds);
  EXPECT_NEAR(estimate.sub_faces, 0.02 / 1.36, 1e-12);
  EXPECT_NEAR(estimate.goals.at(0), 0.02 / 1.36, 1e-12);
}

TEST(StaticAccuracy, NamesTheBlockThatConvergesSlowly) {
  AccuracyRounds rounds;
  rounds.orders = {{{}, {1.0, 1.0}, {0.3, 0.2}}, {{}, {1.0, 1.0}, {0.01, 0.15}}};
  EXPECT_EQ(accuracy_estimate({}, rounds).slow_block, 1);
  rounds.orders.back().missing_energy = {0.01, 0.05};
  EXPECT_EQ(accuracy_estimate({}, rounds).slow_block, -1);
}

/// A plate of 4 m on two edges under its weight, clamped at its ends.
Simulation plate(int order) {
  BlockDefinition block =
      block_of("plate", Polyhedron(make_box({0, 0, 0}, {4, 1, 0.5})), {2500.0, 1e9, 0.2}, order);
  block.supports.push_back({Plane{{0, 0, 0}, Vector3::UnitX()}});
  block.supports.push_back({Plane{{4, 0, 0}, Vector3::UnitX()}});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(block));
  return {std::move(blocks), {{}}, same_law({1e9, 1e9, 0.5}), SimulationSettings{}};
}

double sag(const Simulation& simulation) {
  return 0.25 - place_of(simulation, 0, {2, 0.5, 0.25}).z();
}

// Against the highest order there is, which no estimate knows.
TEST(StaticAccuracy, ReachesWhatIsAskedOfAClampedPlate) {
  Simulation fine = plate(12);
  ASSERT_EQ(run_static(fine, 1.0), StaticStatus::equilibrium);
  const GoalValues goal = [](const Simulation& now) { return std::vector<Goal>{{"middle", {sag(now)}}}; };
  for (const double accuracy : {1e-1, 1e-2}) {
    Simulation simulation = plate(1);
    AccuracyRounds rounds;
    ASSERT_EQ(find_equilibrium(simulation, 1.0, {accuracy, {true}}, goal, rounds, always),
              StaticStatus::equilibrium);
    const double error = std::abs(sag(simulation) / sag(fine) - 1.0);
    EXPECT_LE(error, accuracy);
    const double estimate = accuracy_estimate(goal(simulation), rounds).order;
    EXPECT_LE(error, 3.0 * estimate) << simulation.blocks()[0].order();
    EXPECT_GE(error, estimate / 5.0) << simulation.blocks()[0].order();
  }
}

/// Clamped at one end, 8 by 1 by 3 m. Its tip's deflection was computed by another program.
Simulation cantilever(int order) {
  BlockDefinition block =
      block_of("beam", Polyhedron(make_box({0, -0.5, -1.5}, {8, 0.5, 1.5})), {3600.0, 1e10, 0.2}, order);
  block.supports.push_back({Plane{{0, 0, 0}, Vector3::UnitX()}});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(block));
  return {std::move(blocks), {{}}, same_law({1e9, 1e9, 0.5}), SimulationSettings{}};
}
constexpr double tip_by_another_program = -2.7131353e-3;

// The corners of the clamp: an error that falls like the cube of the order cannot be 1e-4 at order 8.
TEST(StaticAccuracy, EndsEarlyWhereTheHighestOrderWouldNotSuffice) {
  const GoalValues tip = [](const Simulation& now) {
    return std::vector<Goal>{{"tip", {place_of(now, 0, {8, 0, 0}).z()}}};
  };
  Simulation simulation = cantilever(1);
  AccuracyRounds rounds;
  ASSERT_EQ(find_equilibrium(simulation, 1.0, {1e-4, {true}}, tip, rounds, always),
            StaticStatus::equilibrium);
  EXPECT_EQ(simulation.blocks()[0].order(), 6);
  const AccuracyEstimate estimate = accuracy_estimate(tip(simulation), rounds);
  const double error = std::abs(tip(simulation)[0].values[0] / tip_by_another_program - 1.0);
  EXPECT_LT(error, 2.0 * estimate.order);
  EXPECT_GT(error, estimate.order / 3.0);
  EXPECT_EQ(estimate.slow_block, 0);
  Simulation highest = cantilever(8);
  ASSERT_EQ(run_static(highest, 1.0), StaticStatus::equilibrium);
  const double at_highest = std::abs(tip(highest)[0].values[0] / tip_by_another_program - 1.0);
  EXPECT_LT(at_highest, 2.0 * estimate.out_of_reach);
  EXPECT_GT(at_highest, 0.5 * estimate.out_of_reach);
}

// From an equilibrium of other orders no inertia is needed.
TEST(StaticAccuracy, ARoundNeedsFewerIterationsThanAnAnalysis) {
  Simulation simulation = cantilever(2);
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  const int first = simulation.steps();
  (void)simulation.change_order(0, 3);
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  EXPECT_LT(simulation.steps() - first, first / 2);
  Simulation fresh = cantilever(3);
  ASSERT_EQ(run_static(fresh, 1.0), StaticStatus::equilibrium);
  EXPECT_NEAR(place_of(simulation, 0, {8, 0, 0}).z() / place_of(fresh, 0, {8, 0, 0}).z(), 1.0, 1e-9);
}

}  // namespace
}  // namespace ashlar::static_accuracy_test

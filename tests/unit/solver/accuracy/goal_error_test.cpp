#include "solver/accuracy/goal_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/index.hpp"
#include "support/simulations.hpp"

namespace ashlar::goal_error_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_static;
using test_support::same_law;

const Material soft{2500.0, 1e8, 0.0};
constexpr double gravity = 9.81;

/// A block and a point of it whose displacement is a goal.
struct Marked {
  int block;
  Vector3 point;
};

GoalValues displacement_of(const Marked& marked) {
  return [marked](const Simulation& simulation) {
    const Vector3 travel = place_of(simulation, marked.block, marked.point) - marked.point;
    return std::vector<Goal>{{"way", {travel.x(), travel.y(), travel.z()}, 1e-12}};
  };
}

/// Normal force between two blocks.
GoalValues force_between(int a, int b) {
  return [a, b](const Simulation& simulation) {
    double sum = 0.0;
    for (const PairRecord& pair : simulation.contacts())
      if (pair.a == a && pair.b == b)
        for (const PointResponse& response : pair.responses) sum += response.force[0];
    return std::vector<Goal>{{"force", {sum}, 1e-6}};
  };
}

void raise_all(Simulation& simulation) {
  for (int k = 0; k < static_cast<int>(simulation.blocks().size()); ++k)
    if (!simulation.blocks()[at(k)].fixed())
      (void)simulation.change_order(k, simulation.blocks()[at(k)].order() + 2);
}

/// Estimated and found change of a goal by two more orders.
struct Changes {
  double estimated;
  double found;
};
Changes changes_of(Simulation& simulation, const GoalValues& goals, std::size_t component = 0) {
  EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  const std::vector<GoalError> errors = goal_errors(simulation, goals);
  const double before = goals(simulation)[0].values[component];
  raise_all(simulation);
  EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  const double after = goals(simulation)[0].values[component];
  if (errors.size() != 1) {
    ADD_FAILURE() << "no estimate";
    return {};
  }
  return {errors[0].change[component], after - before};
}

Polyhedron box(const Vector3& low, const Vector3& high) {
  return Polyhedron(make_box(low, high));
}

/// Hangs from its upper face.
Simulation hanging_bar(int order) {
  BlockDefinition bar = block_of("bar", box({0, 0, 0}, {0.5, 1, 2}), soft, order);
  bar.supports.push_back({Plane{{0, 0, 2}, Vector3::UnitZ()}});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(bar));
  return {std::move(blocks), {{}}, same_law({1e9, 1e9, 0.5}), SimulationSettings{}};
}

// With s from the support, u = rho g (h s - s^2 / 2) / E; order 1 has the mean strain, u = rho g h s / 2E. In the middle
// the first is 3/8, the second 1/4 of rho g h^2 / E; at the end they are equal.
TEST(GoalErrors, AreThoseOfAHangingBar) {
  const double unit = 2500.0 * gravity * 4.0 / 1e8;
  Simulation bar = hanging_bar(1);
  ASSERT_EQ(run_static(bar, 1.0), StaticStatus::equilibrium);
  const auto middle = goal_errors(bar, displacement_of({0, {0.25, 0.5, 1}}));
  ASSERT_EQ(middle.size(), 1U);
  EXPECT_NEAR(middle[0].change[2] / unit, -0.125, 1e-6);
  EXPECT_NEAR(middle[0].relative, 1.0 / 3.0, 1e-5);
  const auto end = goal_errors(bar, displacement_of({0, {0.25, 0.5, 0}}));
  EXPECT_NEAR(end[0].relative, 0.0, 1e-6);
  Simulation exact = hanging_bar(2);
  ASSERT_EQ(run_static(exact, 1.0), StaticStatus::equilibrium);
  EXPECT_NEAR(goal_errors(exact, displacement_of({0, {0.25, 0.5, 1}}))[0].relative, 0.0, 1e-6);
}

TEST(GoalErrors, AreExactForALinearProblem) {
  BlockDefinition beam = block_of("beam", box({0, 0, 0}, {4, 1, 1}), {2500.0, 1e9, 0.2}, 1);
  beam.supports.push_back({Plane{{0, 0, 0}, Vector3::UnitX()}});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(beam));
  Simulation simulation(std::move(blocks), {{}}, same_law({1e9, 1e9, 0.5}), SimulationSettings{});
  const Changes tip = changes_of(simulation, displacement_of({0, {4, 0.5, 0.5}}), 2);
  EXPECT_NEAR(tip.estimated / tip.found, 1.0, 1e-6);
}

// Two blocks on a base: contact by springs and by multipliers.
TEST(GoalErrors, IncludeContact) {
  for (const bool augmented : {false, true}) {
    std::vector<BlockModel> blocks;
    blocks.emplace_back(fixed_box({-2, -2, -1}, {4, 4, 0}));
    blocks.emplace_back(block_of("lower", box({0, 0, 0}, {2, 1, 1}), {2500.0, 1e8, 0.2}, 1));
    blocks.emplace_back(block_of("upper", box({0.5, 0, 1}, {2, 1, 2}), {2500.0, 1e8, 0.2}, 1));
    SimulationSettings settings;
    settings.augmented = augmented;
    const std::vector<InitialMotion> at_rest(3);
    Simulation simulation(std::move(blocks), at_rest, same_law({1e10, 1e10, 0.6, 0.0, 0.0, true}), settings);
    const Changes top = changes_of(simulation, displacement_of({2, {2, 0.5, 2}}), 2);
    EXPECT_NEAR(top.estimated / top.found, 1.0, 0.2) << augmented << " " << top.estimated << " " << top.found;
  }
}

// A beam over three supports: the middle one takes less the softer the beam is.
TEST(GoalErrors, AreThoseOfForcesToo) {
  for (const bool augmented : {false, true}) {
    std::vector<BlockModel> blocks;
    for (const double x : {0.0, 2.0, 4.0}) blocks.emplace_back(fixed_box({x, 0, -1}, {x + 0.5, 1, 0}));
    blocks.emplace_back(block_of("beam", box({0, 0, 0}, {4.5, 1, 1}), {2500.0, 1e8, 0.2}, 1));
    SimulationSettings settings;
    settings.augmented = augmented;
    const std::vector<InitialMotion> at_rest(4);
    Simulation simulation(std::move(blocks), at_rest, same_law({1e9, 1e9, 0.6, 0.0, 0.0, true}), settings);
    const Changes middle = changes_of(simulation, force_between(1, 3));
    EXPECT_NEAR(middle.estimated / middle.found, 1.0, 0.1)
        << augmented << " " << middle.estimated << " " << middle.found;
  }
}

TEST(GoalErrors, IncludeTies) {
  std::vector<BlockModel> blocks;
  for (const double x : {0.0, 2.0}) {
    BlockDefinition block = block_of("half", box({x, 0, 0}, {x + 2, 1, 1}), {2500.0, 1e9, 0.2}, 1);
    if (x == 0.0) block.supports.push_back({Plane{{0, 0, 0}, Vector3::UnitX()}});
    blocks.emplace_back(std::move(block));
  }
  const std::vector<InitialMotion> at_rest(2);
  Simulation simulation(std::move(blocks), at_rest, same_law({1e9, 1e9, 0.5}), SimulationSettings{},
                        {{0, 1, 1e12}});
  const Changes tip = changes_of(simulation, displacement_of({1, {4, 0.5, 0.5}}), 2);
  EXPECT_NEAR(tip.estimated / tip.found, 1.0, 1e-3) << tip.estimated << " " << tip.found;
}

// Held at four sides, a plate has no motion of an order below 4: x (1 - x) y (1 - y).
TEST(GoalErrors, SeesTheFirstOrderThatMoves) {
  BlockDefinition plate = block_of("plate", box({0, 0, 0}, {1, 1, 0.1}), {2500.0, 1e9, 0.3}, 1);
  for (int axis = 0; axis < 2; ++axis)
    for (const double side : {0.0, 1.0})
      plate.supports.push_back({Plane{side * Vector3::Unit(axis), Vector3::Unit(axis)}});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(plate));
  Simulation simulation(std::move(blocks), {{}}, same_law({1e9, 1e9, 0.5}), SimulationSettings{});
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  const auto errors = goal_errors(simulation, displacement_of({0, {0.5, 0.5, 0.05}}));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_NEAR(errors[0].relative, 1.0, 1e-12);
  EXPECT_LT(errors[0].change[2], 0.0);
}

TEST(GoalErrors, NothingIsEstimatedWithoutHigherOrdersOrGoals) {
  Simulation bar = hanging_bar(1);
  ASSERT_EQ(run_static(bar, 1.0), StaticStatus::equilibrium);
  EXPECT_TRUE(goal_errors(bar, [](const Simulation&) { return std::vector<Goal>{}; }).empty());
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-2, -2, -1}, {4, 4, 0}));
  blocks.emplace_back(block_of("rigid", box({0, 0, 0}, {1, 1, 1}), soft, 0));
  const std::vector<InitialMotion> at_rest(2);
  Simulation rigid(std::move(blocks), at_rest, same_law({1e9, 1e9, 0.5}), SimulationSettings{});
  ASSERT_EQ(run_static(rigid, 1.0), StaticStatus::equilibrium);
  EXPECT_TRUE(goal_errors(rigid, displacement_of({1, {0, 0, 0}})).empty());
}

}  // namespace
}  // namespace ashlar::goal_error_test

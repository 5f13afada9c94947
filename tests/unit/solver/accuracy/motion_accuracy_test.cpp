#include "solver/accuracy/motion_accuracy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::motion_accuracy_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::same_law;

const std::function<bool()> always = [] { return true; };
const GoalValues no_goals = [](const Simulation&) { return std::vector<Goal>(); };

const Material rubber{2000.0, 1e8, 0.25};
constexpr double amplitude = 1e-4;
/// Of a cube that swells by 1 + e: its energy is 9/2 B e^2, with its bulk modulus B, and its inertia for e rho / 4.
const double frequency = std::sqrt(36.0 * 1e8 / (3.0 * (1.0 - 2.0 * 0.25)) / 2000.0);

/// A cube of 1 m that begins to swell.
Simulation swelling(Integrator integrator, double time_step) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("cube", Polyhedron(make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5})), rubber, 1));
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.integrator = integrator;
  settings.time_step = time_step;
  Simulation simulation(std::move(blocks), {{}}, same_law({1e9, 1e9, 0.5}), settings);
  SimulationSnapshot snapshot = simulation.snapshot();
  snapshot.run.states[0].velocity = amplitude * frequency * simulation.states()[0].position;
  simulation.restore(snapshot);
  return simulation;
}

std::vector<Goal> swell(const Simulation& simulation) {
  const PointMotion corner = simulation.blocks()[0].motion_of(simulation.states()[0], {0.5, 0.5, 0.5});
  return {{"corner", {corner.displacement.x()}, 0.0, {corner.velocity.x()}}};
}

/// @return the steps taken
std::vector<double> run(Simulation& simulation, const MotionRequest& request, const GoalValues& goals,
                        MotionAccuracyState& state) {
  std::vector<double> steps;
  while (!simulation.reached(request.end_time)) {
    choose_step(simulation, request, goals, state);
    if (simulation.step(request.end_time) != StepStatus::accepted) break;
    note_step(simulation, state);
    steps.push_back(simulation.report().step);
  }
  return steps;
}

// Two periods; strain and its rate at the end are known.
TEST(MotionAccuracy, StepsMeetWhatIsAsked) {
  const double end = 4.0 * std::numbers::pi / frequency;
  for (const Integrator integrator : {Integrator::average_acceleration, Integrator::generalized_alpha}) {
    for (const double accuracy : {1e-1, 1e-2, 1e-3}) {
      Simulation simulation = swelling(integrator, end / 64);
      const auto pilot = pilot_run(simulation, end, no_goals, always);
      ASSERT_TRUE(pilot);
      MotionAccuracyState state;
      state.scales = pilot->scales;
      const auto steps = run(simulation, {accuracy, end / 4, end}, no_goals, state);
      ASSERT_TRUE(simulation.reached(end));
      const PointMotion corner = simulation.blocks()[0].motion_of(simulation.states()[0], {0.5, 0.5, 0.5});
      const double error = std::hypot(corner.displacement.x() / 0.5 / amplitude,
                                      corner.velocity.x() / 0.5 / (amplitude * frequency) - 1.0);
      EXPECT_LE(error, accuracy) << steps.size() << " steps";
      EXPECT_GE(error, 0.02 * accuracy) << steps.size() << " steps";
      EXPECT_LE(error, 1.5 * state.error);
      EXPECT_LE(state.error, 1.5 * accuracy);
    }
  }
}

TEST(MotionAccuracy, AMeasureIsAGoal) {
  const double end = 4.0 * std::numbers::pi / frequency;
  Simulation simulation = swelling(Integrator::average_acceleration, end / 64);
  const auto pilot = pilot_run(simulation, end, swell, always);
  ASSERT_TRUE(pilot);
  EXPECT_NEAR(pilot->scales.goals.at(0), 0.5 * amplitude, 0.05 * 0.5 * amplitude);
  MotionAccuracyState state;
  state.scales = pilot->scales;
  (void)run(simulation, {1e-3, end / 4, end}, swell, state);
  EXPECT_NEAR(swell(simulation)[0].values[0], 0.0, 1e-3 * 0.5 * amplitude);
}

// Tests are taken back: the same steps given by hand have the same bits.
TEST(MotionAccuracy, TestsLeaveNoTrace) {
  const double end = 4.0 * std::numbers::pi / frequency;
  Simulation chosen = swelling(Integrator::average_acceleration, end / 64);
  const auto pilot = pilot_run(chosen, end, no_goals, always);
  ASSERT_TRUE(pilot);
  EXPECT_EQ(chosen.time(), 0.0);
  EXPECT_EQ(chosen.states()[0].velocity, swelling(Integrator::average_acceleration, 1).states()[0].velocity);
  MotionAccuracyState state;
  state.scales = pilot->scales;
  const auto steps = run(chosen, {1e-2, end / 4, end}, no_goals, state);
  EXPECT_GT(state.tests, 1);
  Simulation given = swelling(Integrator::average_acceleration, end / 64);
  for (const double step : steps) {
    given.set_time_step(step);
    ASSERT_EQ(given.step(end), StepStatus::accepted);
  }
  EXPECT_EQ(given.states()[0].position, chosen.states()[0].position);
  EXPECT_EQ(given.states()[0].velocity, chosen.states()[0].velocity);
}

TEST(MotionAccuracy, ThePilotCanBeEnded) {
  Simulation simulation = swelling(Integrator::dda, 1e-4);
  EXPECT_FALSE(pilot_run(simulation, 1.0, no_goals, [] { return false; }));
  EXPECT_EQ(simulation.time(), 0.0);
}

/// A cube that falls 0.1 m onto a base. @param spin rad/s
Simulation falling(int order, const Vector3& spin) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-2, -2, -1}, {2, 2, 0}));
  blocks.emplace_back(block_of("cube", Polyhedron(make_box({0, 0, 0.1}, {1, 1, 1.1})), rubber, order));
  SimulationSettings settings;
  settings.integrator = Integrator::average_acceleration;
  settings.time_step = 1e-3;
  settings.augmented = true;
  std::vector<InitialMotion> motions(2);
  motions[1].angular_velocity = spin;
  return {std::move(blocks), motions, same_law({1e9, 1e9, 0.5, 0.0, 0.0, true}), settings};
}

// Orders are chosen by what precedes an impact: in free fall each moves alike.
TEST(MotionAccuracy, ThePilotOfOrdersEndsAtTheFirstImpact) {
  const GoalValues middle = [](const Simulation& simulation) {
    const Vector3 travel = place_of(simulation, 1, {0.5, 0.5, 0.6}) - Vector3(0.5, 0.5, 0.6);
    return std::vector<Goal>{{"middle", {travel.x(), travel.y(), travel.z()}}};
  };
  std::vector<AccuracyRound> rounds;
  for (const int order : {1, 2}) {
    Simulation simulation = falling(order, {0.3, 1.0, 0.2});
    const auto pilot = pilot_run(simulation, 0.3, middle, always);
    ASSERT_TRUE(pilot);
    // A corner lands before the cube has fallen by 0.1 m, and its spin adds 1.13 / sqrt(6) m/s at most.
    EXPECT_GT(pilot->scales.impact_speed, 0.5 * std::sqrt(2 * 9.81 * 0.1)) << order;
    EXPECT_LT(pilot->scales.impact_speed, std::sqrt(2 * 9.81 * 0.1) + 0.46) << order;
    EXPECT_LT(pilot->round.energies[1], 2000.0 * (9.81 * 0.1 + 0.5 * 1.13 / 6.0)) << "of motion alone";
    rounds.push_back(pilot->round);
  }
  EXPECT_NEAR(rounds[0].goals[0][2], rounds[1].goals[0][2], 1e-3 * rounds[0].goals[0][2]);
}

// The step of the landing is counted; its place is as exact as asked, and steps afterwards are not much shorter.
TEST(MotionAccuracy, ImpactsAreCounted) {
  Simulation simulation = falling(0, Vector3::Zero());
  const auto pilot = pilot_run(simulation, 0.2, no_goals, always);
  ASSERT_TRUE(pilot);
  MotionAccuracyState state;
  state.scales = pilot->scales;
  const std::vector<double> steps = run(simulation, {1e-2, 0.01, 0.2}, no_goals, state);
  ASSERT_TRUE(simulation.reached(0.2));
  EXPECT_GE(state.impacts, 1);
  EXPECT_LE(state.impacts, 5);
  EXPECT_GT(state.impact_error, 0.0);
  // It lands with sqrt(2 g 0.1) = 1.4 m/s, after 0.1 m: an error of 1 % is a step of 0.7 ms.
  EXPECT_LE(state.impact_error, 1.1e-2);
  EXPECT_GE(*std::min_element(steps.begin(), std::prev(steps.end())), 0.5e-3 * 0.7 / 8.0);
}

}  // namespace
}  // namespace ashlar::motion_accuracy_test

// Blocks that multipliers hold apart stay out of each other, whatever turns, and gain nothing by it.
#include <gtest/gtest.h>

#include <cmath>

#include "support/simulations.hpp"

namespace ashlar::position_projection_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::same_law;

constexpr double tolerance = 1e-6;  // m

const Material rock{2500, 1e9, 0.2};

SimulationSettings augmented(Integrator integrator, double time_step, SimulationSettings settings = {}) {
  settings.integrator = integrator;
  settings.time_step = time_step;
  settings.augmented = true;
  settings.multipliers.penetration_tolerance = tolerance;
  return settings;
}

/// Three dominoes, the first on its way to the second: they lean on each other and rub, face on edge and edge
/// on face, by 0.005 rad a step.
Simulation dominoes(Integrator integrator, int order, SimulationSettings settings = {}) {
  std::vector<BlockModel> blocks;
  std::vector<InitialMotion> motions(4);
  blocks.emplace_back(fixed_box({-5, -5, -1}, {5, 5, 0}));
  for (const double x : {0.0, 0.8, 1.6})
    blocks.emplace_back(
        block_of("domino", Polyhedron(make_box({x, -0.5, 0}, {x + 0.2, 0.5, 2})), rock, order));
  motions[1] = {{1.5, 0, -0.1}, {0, 1.5, 0}};  // about the far lower edge
  return {std::move(blocks), motions, same_law({1e9, 5e8, 0.4, 0.0, 0.0, true}),
          augmented(integrator, 2e-3, settings)};
}

class MovedApartBy : public ::testing::TestWithParam<Integrator> {};

TEST_P(MovedApartBy, NothingIsDeeperThanTheToleranceAndNothingIsGained) {
  for (const int order : GetParam() == Integrator::dda ? std::vector{1, 2} : std::vector{1}) {
    Simulation simulation = dominoes(GetParam(), order);
    while (!simulation.reached(1.3)) {
      ASSERT_EQ(simulation.step(1.3), StepStatus::accepted);
      EXPECT_LE(simulation.report().penetration, tolerance) << order << ' ' << simulation.time();
    }
    // The last one is falling.
    EXPECT_LT(test_support::place_of(simulation, 3, {1.7, 0, 2}).z(), 1.9);
    for (const Rejection& rejection : simulation.rejections())
      EXPECT_EQ(rejection.reason, RejectionReason::passing) << rejection.time;
    EXPECT_LE(simulation.ledger().redetection_gained, 1e-9 * simulation.largest_energy());
    EXPECT_LE(simulation.largest_step_residual(), 1e-9 * simulation.largest_energy());
  }
}

INSTANTIATE_TEST_SUITE_P(Every, MovedApartBy,
                         ::testing::Values(Integrator::dda, Integrator::average_acceleration,
                                           Integrator::generalized_alpha));

/// A bar of length 3.2 and height 0.2 m that lies across a rim without friction, its middle 0.4 m beyond.
/// Lagrange's equations in s, from the foot of the middle to the rim, and the tilt t, by Runge and Kutta.
/// @return momentum along x and z by mass, m/s
std::array<double, 2> speed_of_a_sliding_bar(double time) {
  constexpr double g = 9.81, h = 0.1, inertia = (3.2 * 3.2 + 0.2 * 0.2) / 12.0;
  using State = Eigen::Vector4d;  // s, t and their rates
  const auto rate = [&](const State& y) -> State {
    const double s = y[0], sin = std::sin(y[1]), cos = std::cos(y[1]);
    Eigen::Matrix2d mass;
    mass << 1.0, h, h, h * h + s * s + inertia;
    const Eigen::Vector2d force(s * y[3] * y[3] + g * sin, g * (s * cos + h * sin) - 2.0 * s * y[2] * y[3]);
    const Eigen::Vector2d change = mass.inverse() * force;
    return {y[2], y[3], change[0], change[1]};
  };
  State y(0.4, 0, 0, 0);
  constexpr int steps = 2000;
  const double d = time / steps;
  for (int k = 0; k < steps; ++k) {
    const State k1 = rate(y), k2 = rate(y + 0.5 * d * k1), k3 = rate(y + 0.5 * d * k2), k4 = rate(y + d * k3);
    y += d / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  const double along = y[2] + h * y[3], across = y[0] * y[3];
  return {along * std::cos(y[1]) - across * std::sin(y[1]),
          -along * std::sin(y[1]) - across * std::cos(y[1])};
}

/// The same bar, released at rest. @param young modulus, Pa
Simulation bar_over_a_rim(double time_step, double young, double penetration_tolerance) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-0.2, -1, -1}, {0, 1.5, 0}));
  blocks.emplace_back(
      block_of("bar", Polyhedron(make_box({-1.2, 0, 0}, {2, 0.5, 0.2})), {2500, young, 0.2}, 1));
  SimulationSettings settings = augmented(Integrator::dda, time_step);
  settings.multipliers.penetration_tolerance = penetration_tolerance;
  return {std::move(blocks), {{}, {}}, same_law({1.6e10, 8e9, 0.0, 0.0, 0.0, true}), settings};
}

TEST(MovedApart, ABarSlidesOverARimAsLongAsItsFaceTurns) {
  // Nothing but slip pays for what the face that turns comes to meet.
  const auto check = [](double time_step, double time, double error) {
    Simulation simulation = bar_over_a_rim(time_step, 1e10, tolerance);
    while (!simulation.reached(time)) {
      const Vector3 before = simulation.momentum();
      ASSERT_EQ(simulation.step(time), StepStatus::accepted);
      ASSERT_LE(simulation.report().penetration, tolerance) << simulation.time();
      Vector3 force(0, 0, -800.0 * 9.81);
      for (const PairRecord& record : simulation.contacts()) force -= force_on_a(record);
      const Vector3 change = simulation.momentum() - before;
      ASSERT_LE((change - simulation.report().step * force).norm(), 1e-9 * 800.0) << simulation.time();
    }
    const auto [x, z] = speed_of_a_sliding_bar(time);
    EXPECT_NEAR(simulation.momentum().x() / 800.0, x, error * std::hypot(x, z));
    EXPECT_NEAR(simulation.momentum().z() / 800.0, z, error * std::hypot(x, z));
    EXPECT_LE(simulation.ledger().redetection_gained, 1e-8 * simulation.largest_energy());
    EXPECT_LE(simulation.largest_step_residual(), 1e-11 * simulation.largest_energy());
  };
  check(2e-3, 0.5, 4e-3);
  // The end that lifts is not held down by impulses.
  check(2e-4, 0.3, 1e-3);
}

TEST(MovedApart, ABarThatSlidesOverARimIsSecondOrderInTheTimeStep) {
  struct Errors {
    double momentum;  // as a share
    double energy;    // as a share of the kinetic energy
  };
  constexpr double time = 0.5;
  const auto errors_of = [](double time_step) -> Errors {
    // So stiff that compliance does not contribute to the errors.
    Simulation simulation = bar_over_a_rim(time_step, 1e13, 1e-9);
    const auto energy = [&] {
      const Ledger& ledger = simulation.ledger();
      return ledger.kinetic + ledger.elastic + ledger.gravity;
    };
    const double start = energy();
    while (!simulation.reached(time)) {
      EXPECT_EQ(simulation.step(time), StepStatus::accepted);
      EXPECT_LE(simulation.report().penetration, 1e-9) << simulation.time();
    }
    const auto [x, z] = speed_of_a_sliding_bar(time);
    const Vector3 speed = simulation.momentum() / 800.0;
    return {std::hypot(speed.x() - x, speed.z() - z) / std::hypot(x, z),
            std::abs(energy() - start) / simulation.ledger().kinetic};
  };
  const Errors coarse = errors_of(4e-3);
  const Errors middle = errors_of(2e-3);
  const Errors fine = errors_of(1e-3);
  // Steps of half the length leave a quarter of the error, of a first-order method a half.
  for (const auto& [longer, shorter] : {std::pair{coarse, middle}, std::pair{middle, fine}}) {
    EXPECT_GT(longer.momentum / shorter.momentum, 3.0);
    EXPECT_GT(longer.energy / shorter.energy, 3.0);
  }
  // Rows at the start of a step left 2e-3 and 5e-4.
  EXPECT_LT(middle.momentum, 1e-5);
  EXPECT_LT(middle.energy, 3e-7);
}

TEST(MovedApartFailed, LeavesTheLastAcceptedState) {
  // With so few balances allowed some step fails, and the dominoes are moved apart before most.
  int failed = 0;
  for (int rounds = 1; rounds < 4; ++rounds) {
    SimulationSettings settings;
    settings.max_step_cuts = 0;
    settings.multipliers.rounds = rounds;
    Simulation simulation = dominoes(Integrator::dda, 1, settings);
    while (!simulation.reached(1.3)) {
      const std::vector<BlockState> before = simulation.states();
      const double numerical = simulation.ledger().numerical;
      if (simulation.step(1.3) == StepStatus::accepted) continue;
      ++failed;
      EXPECT_FALSE(simulation.rejections().empty());
      EXPECT_EQ(simulation.ledger().numerical, numerical);
      for (std::size_t k = 0; k < before.size(); ++k) {
        EXPECT_EQ(simulation.states()[k].position, before[k].position) << rounds << ' ' << k;
        EXPECT_EQ(simulation.states()[k].velocity, before[k].velocity) << rounds << ' ' << k;
      }
      break;
    }
  }
  EXPECT_GT(failed, 0);
}

TEST(MovedApartFree, KeepsMomentumAndAngularMomentum) {
  // Three blocks that turn meet, rub and part.
  SimulationSettings settings = augmented(Integrator::dda, 1e-3);
  settings.gravity.setZero();
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("a", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 1));
  blocks.emplace_back(block_of("b", Polyhedron(make_box({1.3, 0.3, 0.2}, {2.0, 1.5, 2.0})), rock, 2));
  blocks.emplace_back(block_of("c", Polyhedron(make_box({2.2, 0.5, 0.5}, {3.0, 1.5, 2.2})), rock, 1));
  const std::vector<InitialMotion> motions{
      {{2, 0.3, 0}, {0.5, 1.5, 0.7}}, {{0, 0, 0}, {0.1, -0.5, 0.9}}, {{-1, 0, 0}, {0, 0, 0}}};
  Simulation simulation(std::move(blocks), motions, same_law({1e9, 5e8, 0.6, 0.0, 0.0, true}), settings);
  const Vector3 momentum = simulation.momentum();
  const Vector3 angular = simulation.angular_momentum();
  const double energy = simulation.ledger().kinetic;
  int touching = 0;
  while (!simulation.reached(1.0)) {
    ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
    EXPECT_LE(simulation.ledger().kinetic + simulation.ledger().elastic, (1.0 + 1e-12) * energy);
    EXPECT_LE(simulation.report().penetration, tolerance);
    touching += simulation.report().locked + simulation.report().sliding > 0 ? 1 : 0;
  }
  EXPECT_GT(touching, 10);
  EXPECT_LT((simulation.momentum() - momentum).norm(), 1e-11 * momentum.norm());
  EXPECT_LT((simulation.angular_momentum() - angular).norm(), 1e-10 * angular.norm());
  EXPECT_LE(simulation.largest_step_residual(), 1e-10 * simulation.largest_energy());
}

}  // namespace
}  // namespace ashlar::position_projection_test

// The integrators against closed forms: mass damping, the generalized-alpha step and its stability in
// contact.
#include "solver/step/island/time_scheme.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "support/simulations.hpp"

namespace ashlar::time_scheme_test {
namespace {

using test_support::block_of;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;

constexpr double alpha = 0.7;  // 1/s

Simulation falling_block(Integrator integrator, double step) {
  SimulationSettings settings;
  settings.integrator = integrator;
  settings.time_step = step;
  settings.mass_damping = alpha;
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 2, 3})), {2500.0, 1e9, 0.2}, 2));
  InitialMotion motion;
  motion.velocity = {3, 0, 4};
  return Simulation(std::move(blocks), {motion}, same_law({}), settings);
}

Vector3 mean_velocity(const Simulation& simulation) {
  return simulation.momentum() / simulation.blocks()[0].mass();
}

TEST(MassDamping, FreeFallFollowsTheRecurrenceOfTheStep) {
  const Vector3 gravity(0, 0, -9.81);
  for (const Integrator integrator : {Integrator::dda, Integrator::average_acceleration}) {
    const double dt = 0.02;
    Simulation simulation = falling_block(integrator, dt);
    const Vector3 start = place_of(simulation, 0, {0.5, 1, 1.5});
    Vector3 velocity(3, 0, 4);
    Vector3 path(0, 0, 0);
    for (int k = 0; k < 50; ++k) {
      // dda: (v' - v)/dt = g - alpha v';  average: (v' - v)/dt = g - alpha (v + v')/2;
      // both D = dt (v + v')/2
      const Vector3 next =
          integrator == Integrator::dda
              ? Vector3((velocity + dt * gravity) / (1.0 + alpha * dt))
              : Vector3(((1.0 - 0.5 * alpha * dt) * velocity + dt * gravity) / (1.0 + 0.5 * alpha * dt));
      path += 0.5 * dt * (velocity + next);
      velocity = next;
    }
    ASSERT_TRUE(run_until(simulation, 1.0));
    EXPECT_LT((mean_velocity(simulation) - velocity).norm(), 1e-11);
    EXPECT_LT((place_of(simulation, 0, {0.5, 1, 1.5}) - start - path).norm(), 1e-11);
  }
}

TEST(MassDamping, TakesExactlyWhatTheLedgerSays) {
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    Simulation simulation = falling_block(integrator, 0.02);
    ASSERT_TRUE(run_until(simulation, 2.0));
    const Ledger& ledger = simulation.ledger();
    EXPECT_GT(ledger.damping, 0.1 * ledger.kinetic);
    EXPECT_LT(std::abs(ledger.residual), 1e-10 * ledger.kinetic);
    // The force is taken at the scheme's own place in the step, of first order for all but the average one:
    // work of alpha M v along the exact path, v(t) = v_end + (v_0 - v_end) exp(-alpha t)
    const auto dissipated = [](double start, double end) {
      const double gap = start - end;
      const double decay = std::exp(-alpha * 2.0);
      return alpha * (end * end * 2.0 + 2.0 * end * gap * (1.0 - decay) / alpha +
                      gap * gap * (1.0 - decay * decay) / (2.0 * alpha));
    };
    const double expected = 6.0 * 2500.0 * (dissipated(3.0, 0.0) + dissipated(4.0, -9.81 / alpha));
    EXPECT_NEAR(ledger.damping, expected,
                (integrator == Integrator::average_acceleration ? 1e-4 : 2e-2) * expected);
  }
}

/// A bar of order 1 clamped at x = 0: u_x = X y(t) with w^2 = 3 E / (rho L^2) for nu = 0.
Simulation clamped_bar(double radius, double step, double damping = 0.0) {
  SimulationSettings settings;
  settings.integrator = Integrator::generalized_alpha;
  settings.spectral_radius = radius;
  settings.time_step = step;
  settings.mass_damping = damping;
  settings.gravity.setZero();
  BlockDefinition bar = block_of("A", Polyhedron(make_box({0, 0, 0}, {2, 1, 1})), {3.0, 4.0, 0.0}, 1);
  bar.supports.push_back({Plane{{0, 0, 0}, {1, 0, 0}}});
  InitialMotion motion;
  motion.velocity = {1, 0, 0};
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(bar));
  return Simulation(std::move(blocks), {motion}, same_law({}), settings);
}
constexpr double squared_frequency = 3.0 * 4.0 / (3.0 * 2.0 * 2.0);  // 1/s^2

double tip(const Simulation& simulation) {
  return place_of(simulation, 0, {2, 0.5, 0.5}).x() - 2.0;
}
double tip_velocity(const Simulation& simulation) {
  return simulation.states()[0].velocity.col(0).dot(
      simulation.blocks()[0].basis().values(Vector3(2, 0.5, 0.5)));
}

/// Chung and Hulbert's amplification of (x, v, a) for x'' + c x' + w^2 x = 0.
Eigen::Matrix3d amplification(double radius, double dt, double squared, double c) {
  const double am = (2 * radius - 1) / (radius + 1);
  const double af = radius / (radius + 1);
  const double gamma = 0.5 - am + af;
  const double beta = 0.25 * (1 - am + af) * (1 - am + af);
  Eigen::Matrix3d after;
  Eigen::Matrix3d before;
  after << 1, 0, -beta * dt * dt, 0, 1, -gamma * dt, (1 - af) * squared, (1 - af) * c, 1 - am;
  before << 1, dt, (0.5 - beta) * dt * dt, 0, 1, (1 - gamma) * dt, -af * squared, -af * c, -am;
  return after.partialPivLu().solve(before);
}

double spectral_radius(const Eigen::Matrix3d& matrix) {
  return Eigen::EigenSolver<Eigen::Matrix3d>(matrix).eigenvalues().cwiseAbs().maxCoeff();
}

TEST(GeneralizedAlpha, OneModeFollowsItsAmplificationMatrix) {
  for (const double radius : {0.0, 0.3, 0.8, 1.0}) {
    for (const double step : {0.1, 1.0, 30.0}) {
      for (const double damping : {0.0, 0.4}) {
        Simulation simulation = clamped_bar(radius, step, damping);
        Eigen::Vector3d expected(0.0, tip_velocity(simulation), -damping * tip_velocity(simulation));
        const double scale = expected[1] * step;
        const Eigen::Matrix3d matrix = amplification(radius, step, squared_frequency, damping);
        for (int k = 0; k < 20; ++k) {
          ASSERT_EQ(simulation.step(1e6), StepStatus::accepted);
          expected = matrix * expected;
          ASSERT_NEAR(tip(simulation), expected[0], 1e-9 * scale) << radius << ' ' << step << ' ' << k;
          ASSERT_NEAR(tip_velocity(simulation), expected[1], 1e-9 * scale) << radius << ' ' << step;
        }
      }
    }
    // The matrix keeps `radius` of the highest frequencies: a double root, accurate to the root of rounding.
    EXPECT_NEAR(spectral_radius(amplification(radius, 1.0, 1e12, 0.0)), radius, 1e-3);
  }
}

TEST(GeneralizedAlpha, RadiusOneDissipatesNothing) {
  Simulation simulation = clamped_bar(1.0, 0.7);
  const double start = simulation.ledger().balance();
  for (int k = 0; k < 2000; ++k) ASSERT_EQ(simulation.step(1e6), StepStatus::accepted);
  EXPECT_NEAR(simulation.ledger().kinetic + simulation.ledger().elastic, start, 1e-10 * start);
  EXPECT_NEAR(simulation.ledger().numerical, 0.0, 1e-10 * start);
}

TEST(GeneralizedAlpha, IsOfSecondOrder) {
  const double frequency = std::sqrt(squared_frequency);
  const auto error = [&](double step) {
    Simulation simulation = clamped_bar(0.5, step);
    const double exact = tip_velocity(simulation) / frequency * std::sin(frequency * 4.0);
    EXPECT_TRUE(run_until(simulation, 4.0));
    EXPECT_NEAR(simulation.ledger().residual, 0.0, 1e-11);
    return std::abs(tip(simulation) - exact);
  };
  EXPECT_NEAR(error(0.02) / error(0.01), 4.0, 0.2);
  EXPECT_NEAR(error(0.01) / error(0.005), 4.0, 0.1);
}

// One mass on an elastic and a contact spring: the contact force of the step's end must not feed energy in.
TEST(GeneralizedAlpha, IsStableWithAContactSpringOfAnyStiffness) {
  for (const double radius : {0.0, 0.2, 0.5, 0.8, 0.95, 1.0}) {
    for (const double damping : {0.0, 0.1, 1.0, 3.0}) {
      SimulationSettings settings;
      settings.integrator = Integrator::generalized_alpha;
      settings.spectral_radius = radius;
      settings.mass_damping = damping;
      const TimeScheme scheme = time_scheme(settings, 1.0);
      for (int i = 0; i < 48; ++i) {
        const double elastic = 1e-6 * std::pow(1.7, i);
        for (int j = 0; j < 53; ++j) {
          const double contact = 1e-6 * std::pow(1.7, j);
          Eigen::Matrix3d matrix;
          for (int column = 0; column < 3; ++column) {
            const Eigen::Vector3d s = Eigen::Vector3d::Unit(column);
            const double d = (scheme.inertia * scheme.free_change(0.0, s[1], s[2]) -
                              (scheme.force_weight * elastic + contact) * s[0]) /
                             (scheme.inertia + scheme.force_weight * scheme.end_share * elastic + contact);
            const double smooth =
                -elastic * (s[0] + scheme.end_share * d) - damping * scheme.damped_velocity(d, s[1], s[2]);
            matrix.col(column) << s[0] + d, scheme.end_velocity(d, s[1], s[2]),
                scheme.end_acceleration(smooth, s[2]);
          }
          ASSERT_LT(spectral_radius(matrix), 1.0 + 1e-6)
              << radius << ' ' << damping << ' ' << elastic << ' ' << contact;
        }
      }
    }
  }
}

TEST(GeneralizedAlpha, CollisionKeepsMomentum) {
  SimulationSettings settings;
  settings.integrator = Integrator::generalized_alpha;
  settings.gravity.setZero();
  settings.time_step = 2e-4;
  InitialMotion motion;
  motion.velocity = {3.0, 0.2, -0.1};
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2000, 1e8, 0.2}, 2));
  blocks.emplace_back(
      block_of("B", Polyhedron(make_box({1.05, 0.6, 0.3}, {2.05, 1.6, 1.3})), {2500, 1e8, 0.3}, 1));
  Simulation simulation(std::move(blocks), {motion, {}}, same_law({1e9, 5e8, 0.5, 0.0, 0.0, true}), settings);
  const Vector3 momentum = simulation.momentum();
  ASSERT_TRUE(run_until(simulation, 0.1));
  EXPECT_LT((simulation.momentum() - momentum).norm(), 1e-10 * momentum.norm());
  EXPECT_GT(simulation.blocks()[1].momentum(simulation.states()[1]).norm(), 0.1 * momentum.norm());
}

}  // namespace
}  // namespace ashlar::time_scheme_test

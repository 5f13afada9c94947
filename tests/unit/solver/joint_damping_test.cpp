// Damped joints against closed forms of a body on a spring and a dashpot (mechanics/notes/joint_damping.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "support/simulations.hpp"

namespace ashlar::joint_damping_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;

constexpr double density = 2000.0, kn = 5e7, ks = 2e7, area = 0.12, mass = density * area * 0.2;

struct Body {
  double share;  ///< of critical damping
  Integrator integrator = Integrator::average_acceleration;
  int order = 0;
  bool area_springs = true;
  bool bonded = false;
  bool both_move = false;
};

/// A box that touches a plate, or another box of its size, at the origin, and moves.
Simulation on_springs(const Body& body, double step, const Vector3& velocity) {
  std::vector<BlockModel> blocks;
  const Material stiff{density, 1e12, 0.0};
  if (body.both_move)
    blocks.emplace_back(
        block_of("below", Polyhedron(make_box({-0.2, -0.15, -0.2}, {0.2, 0.15, 0})), stiff, body.order));
  else
    blocks.emplace_back(fixed_box({-1, -1, -1}, {1, 1, 0}));
  blocks.emplace_back(
      block_of("box", Polyhedron(make_box({-0.2, -0.15, 0}, {0.2, 0.15, 0.2})), stiff, body.order));
  const double scale = body.area_springs ? 1.0 : area / 4.0;  // four corners
  JointLaw law{kn * scale, ks * scale, 0.5, 0.0, 0.0, body.area_springs};
  law.damping = body.share;
  if (body.bonded) law.cohesion = law.tensile_strength = 1e12;
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.time_step = step;
  settings.integrator = body.integrator;
  settings.spectral_radius = 1.0;
  settings.area_springs = body.area_springs;
  settings.rest.sleeps = false;
  return {std::move(blocks), {{}, {velocity, Vector3::Zero()}}, same_law(law), settings};
}

double frequency(double stiffness, double moving) {
  return std::sqrt(stiffness * area / moving);
}

// x'' + 2 z w x' + w^2 x = 0 from x = 0: after n half periods the speed is exp(-z w t) of what it was.
TEST(JointDamping, ABondedBoxSwingsOutByItsShareOfCritical) {
  for (const bool area_springs : {true, false}) {
    for (const bool both_move : {false, true}) {
      const double moving = both_move ? 0.5 * mass : mass;
      const Body body{0.08, Integrator::average_acceleration, 0, area_springs, true, both_move};
      const double natural = frequency(kn, moving);
      const double half = std::numbers::pi / (natural * std::sqrt(1.0 - body.share * body.share));
      Simulation simulation = on_springs(body, half / 200, {0, 0, 0.01});
      const int halves = 4;
      for (int k = 0; k < halves * 200; ++k) ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
      const auto speed = [&](int block) {
        return (simulation.states()[static_cast<std::size_t>(block)].velocity.transpose() *
                simulation.blocks()[static_cast<std::size_t>(block)].basis().values(Vector3(0, 0, 0)))
            .z();
      };
      const double left = std::exp(-body.share * natural * halves * half);
      const double relative = speed(1) - (both_move ? speed(0) : 0.0);
      EXPECT_NEAR(relative, 0.01 * left, 0.01 * 0.01 * left) << area_springs << both_move;
      const Ledger& ledger = simulation.ledger();
      const double given = 0.5 * moving * 1e-4;
      EXPECT_NEAR(ledger.damping, given * (1.0 - left * left), 0.01 * given);
      EXPECT_LT(std::abs(ledger.numerical), 1e-6 * given);
      EXPECT_LT(simulation.largest_step_residual(), 1e-9 * given);
    }
  }
}

// The same for the shear springs, where the box does not slide.
TEST(JointDamping, ShearSwingsOutToo) {
  Body body{0.05};
  body.bonded = true;
  // A flat box hardly rocks: its centroid is 0.1 m above the joint, so that both motions mix. Both are damped.
  Simulation simulation = on_springs(body, 5e-5, {0.01, 0, 0});
  ASSERT_TRUE(run_until(simulation, 0.6));
  const double given = 0.5 * mass * 1e-4;
  EXPECT_LT(simulation.ledger().kinetic, 1e-3 * given);
  EXPECT_NEAR(simulation.ledger().damping, given, 0.01 * given);
}

class Restitution : public testing::TestWithParam<std::tuple<Integrator, double>> {};

// A Kelvin-Voigt contact that separates at zero force (Schwager and Poeschel 2007):
// e = exp(-z/sqrt(1 - z^2) (pi - 2 asin z)).
TEST_P(Restitution, IsThatOfAKelvinVoigtContactWithoutTension) {
  const auto [integrator, share] = GetParam();
  Body body{share, integrator};
  body.order = integrator == Integrator::generalized_alpha ? 1 : 0;
  const double natural = frequency(kn, mass);
  Simulation simulation = on_springs(body, 1e-3 / natural, {0, 0, -0.1});
  ASSERT_TRUE(run_until(simulation, 4.0 / natural));
  EXPECT_EQ(simulation.report().locked + simulation.report().sliding, 0);
  const double rebound = (simulation.states()[1].velocity.transpose() *
                          simulation.blocks()[1].basis().values(Vector3(0, 0, 0.1)))
                             .z() /
                         0.1;
  const double reference =
      std::exp(-share / std::sqrt(1.0 - share * share) * (std::numbers::pi - 2.0 * std::asin(share)));
  EXPECT_NEAR(rebound, reference, 0.005);
  const double given = 0.5 * mass * 0.01;
  EXPECT_NEAR(simulation.ledger().damping, (1.0 - reference * reference) * given, 0.01 * given);
}

INSTANTIATE_TEST_SUITE_P(Of, Restitution,
                         testing::Combine(testing::Values(Integrator::dda, Integrator::average_acceleration,
                                                          Integrator::generalized_alpha),
                                          testing::Values(0.05, 0.2, 0.6)));

/// Largest tilt of a column of 0.5 x 0.5 x 2 m on ground that shakes for three smooth cycles, and the tilt 1 s
/// later.
std::array<double, 2> rocked(double share, double step) {
  SupportHistory shaking;
  shaking.record = MotionRecord::acceleration;
  for (int k = 0; k <= 300; ++k) {
    const double time = 0.01 * k, swell = std::sin(std::numbers::pi * time / 3.0);
    shaking.times.push_back(time);
    shaking.values.emplace_back(3.4 * swell * swell * std::sin(2.0 * std::numbers::pi * time), 0, 0);
  }
  BlockDefinition ground =
      block_of("ground", Polyhedron(make_box({-1, -1, -0.2}, {1, 1, 0})), {2500, 1e10, 0.2}, 1);
  for (const double z : {-0.2, 0.0})
    ground.supports.push_back({Plane{{0, 0, z}, Vector3::UnitZ()}, {true, true, true}, shaking});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(ground));
  blocks.emplace_back(
      block_of("column", Polyhedron(make_box({-0.25, -0.25, 0}, {0.25, 0.25, 2})), {2500, 1e10, 0.2}, 1));
  JointLaw law{1e9, 5e8, 0.7, 0.0, 0.0, true};
  law.damping = share;
  SimulationSettings settings;
  settings.integrator = Integrator::average_acceleration;
  settings.time_step = step;
  Simulation simulation(std::move(blocks), {{}, {}}, same_law(law), settings);
  std::array<double, 2> largest{0.0, 0.0};
  while (!simulation.reached(4.0)) {
    EXPECT_EQ(simulation.step(4.0), StepStatus::accepted);
    const Vector3 axis = place_of(simulation, 1, {0, 0, 2}) - place_of(simulation, 1, {0, 0, 0});
    double& most = largest[simulation.time() < 3.0 ? 0 : 1];
    most = std::max(most, std::abs(axis.x()) / 2.0);
  }
  return largest;
}

// The rocking of a column depends on its joint, not on the step.
TEST(JointDamping, ARockingColumnDoesNotDependOnTheStep) {
  const auto [coarse, coarse_late] = rocked(0.1, 2e-3);
  const auto [fine, fine_late] = rocked(0.1, 5e-4);
  EXPECT_GT(fine, 0.05);
  EXPECT_NEAR(coarse, fine, 0.03 * fine);
  EXPECT_NEAR(coarse_late, fine_late, 0.03 * fine);
}

// Long steps too: nothing pulls, nothing gains.
TEST(JointDamping, NeverPullsAndNeverGivesEnergy) {
  for (const Integrator integrator : {Integrator::dda, Integrator::average_acceleration}) {
    for (const double step : {1e-4, 1e-3, 1e-2}) {
      Body body{1.0, integrator};
      Simulation simulation = on_springs(body, step, {0.02, 0.01, -0.1});
      double last = simulation.ledger().kinetic;
      for (int k = 0; k < 50; ++k) {
        ASSERT_EQ(simulation.step(10.0), StepStatus::accepted);
        for (const PairRecord& pair : simulation.contacts())
          for (const PointResponse& point : pair.responses) EXPECT_GE(point.force[0], 0.0);
        const double now = simulation.ledger().kinetic + simulation.ledger().contact;
        EXPECT_LE(now, last * (1.0 + 1e-12)) << step;
        last = now;
      }
    }
  }
}

}  // namespace
}  // namespace ashlar::joint_damping_test

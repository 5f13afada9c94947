// Damping by stiffness against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::stiffness_damping_test {
namespace {

constexpr double density = 2500.0;
constexpr double young = 1e8;
constexpr double poisson = 0.25;
/// Vibration of a cube of 1 m that swells by (1 + e): energy 9/2 B e^2 with B = E / (3 (1 - 2 nu)), inertia rho / 4 for e.
const double frequency = std::sqrt(36.0 * young / (3.0 * (1.0 - 2.0 * poisson)) / density);

class StiffnessDamping : public testing::TestWithParam<std::tuple<Elasticity, Integrator>> {
 protected:
  /// A cube about the origin, free, without gravity.
  [[nodiscard]] static Simulation cube(const SimulationSettings& settings, const InitialMotion& motion) {
    Material material{density, young, poisson};
    material.elasticity = std::get<0>(GetParam());
    std::vector<BlockModel> blocks;
    blocks.emplace_back(test_support::block_of(
        "cube", Polyhedron(make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5})), material, 1));
    return {std::move(blocks), {motion}, test_support::same_law({1e9, 1e9, 0.5, 0.0, 0.0, true}), settings};
  }
  static SimulationSettings settings_of(double step, double beta) {
    SimulationSettings settings;
    settings.gravity = Vector3::Zero();
    settings.integrator = std::get<1>(GetParam());
    settings.spectral_radius = 1.0;  // no dissipation of its own
    settings.time_step = step;
    settings.stiffness_damping = beta;
    return settings;
  }
};

// From e = 0 and a rate, e is 0 again after each half period, with exp(-beta w^2 t / 2) of the rate.
TEST_P(StiffnessDamping, AVibrationDiesOutAsRayleighSays) {
  constexpr double share = 0.05;  // of critical
  constexpr int halves = 4;
  constexpr int steps = 50;  // of half a period
  const double beta = 2.0 * share / frequency;
  const double half = std::numbers::pi / (frequency * std::sqrt(1.0 - share * share));
  Simulation simulation = cube(settings_of(half / steps, beta), {});
  SimulationSnapshot swelling = simulation.snapshot();
  swelling.run.states[0].velocity = 1e-3 * swelling.run.states[0].position;
  simulation.restore(swelling);
  // rho / 2 int |v|^2 = rho / 2 rate^2 3/12.
  const double before = density / 8.0 * 1e-6;
  for (int k = 0; k < halves * steps; ++k) ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
  const double left = std::exp(-beta * frequency * frequency * halves * half);
  const Ledger& ledger = simulation.ledger();
  EXPECT_NEAR(ledger.kinetic, left * before, 0.01 * left * before);
  EXPECT_LT(ledger.elastic, 0.01 * left * before);
  EXPECT_NEAR(ledger.damping, before - ledger.kinetic - ledger.elastic, 1e-3 * before);
  // The ledger has not seen where the vibration came from, and nothing else is missing.
  EXPECT_NEAR(std::abs(ledger.residual), before, 1e-6 * before);
}

// A force that lagged behind the block would brake a stressed one: by beta sigma V w^2, 0.1 a second here.
TEST_P(StiffnessDamping, ABlockThatSpinsIsNotHeldBack) {
  InitialMotion spin;
  spin.angular_velocity = {0, 0, 10.0};
  Simulation simulation = cube(settings_of(1e-3, 1e-3), spin);
  ASSERT_TRUE(test_support::run_until(simulation, 0.5));
  const double before = simulation.ledger().kinetic;
  EXPECT_NEAR(before, 0.5 * density / 6.0 * 100.0, 0.01 * before);
  ASSERT_TRUE(test_support::run_until(simulation, 1.0));
  EXPECT_NEAR(simulation.ledger().kinetic, before, 1e-6 * before);
}

// A damper of 300 time steps and more: its force is that of the rounding of places times beta / dt, far beyond what elastic
// forces are known to, and no step may wait for better. The weight of two cubes compresses the lower one as a damper and
// a spring side by side do: by sigma / E (1 - exp(-t / beta)), sigma in its middle.
TEST(HeavyStiffnessDamping, CubesInContactSettleAsDampersDo) {
  for (const double beta : {0.3, 3.0}) {
    const Material material{2000.0, 1e9, 0.0};
    std::vector<BlockModel> blocks;
    blocks.emplace_back(test_support::fixed_box({-2, -2, -1}, {2, 2, 0}));
    blocks.emplace_back(test_support::block_of("a", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), material, 1));
    blocks.emplace_back(test_support::block_of("b", Polyhedron(make_box({0, 0, 1}, {1, 1, 2})), material, 1));
    SimulationSettings settings;
    settings.gravity = {0, 0, -10};
    settings.time_step = 1e-3;
    settings.stiffness_damping = beta;
    Simulation simulation(std::move(blocks), {{}, {}, {}},
                          test_support::same_law({1e12, 1e12, 0.5, 0.0, 0.0, true}), settings);
    ASSERT_TRUE(test_support::run_until(simulation, 0.03));
    EXPECT_TRUE(simulation.rejections().empty()) << simulation.rejections().size();
    const double length = test_support::place_of(simulation, 1, {0.5, 0.5, 1.0}).z() -
                          test_support::place_of(simulation, 1, {0.5, 0.5, 0.0}).z();
    const double expected = 1.5 * 2000.0 * 10.0 / 1e9 * -std::expm1(-0.03 / beta);
    // The dda step is of first order: dt / (2 t).
    EXPECT_NEAR(1.0 - length, expected, 0.05 * expected) << beta;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, StiffnessDamping,
    testing::Combine(testing::Values(Elasticity::linear, Elasticity::st_venant_kirchhoff),
                     testing::Values(Integrator::average_acceleration, Integrator::generalized_alpha)));

}  // namespace
}  // namespace ashlar::stiffness_damping_test

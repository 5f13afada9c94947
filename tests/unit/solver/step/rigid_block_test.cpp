// Rigid blocks, of order 0 (mechanics/block/rigid_body.hpp): motions that the laws of rigid bodies give.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::rigid_block_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;
using test_support::tilted_box;

constexpr double degree = std::numbers::pi / 180.0;
const Material rock{2000.0, 1e9, 0.2};

SimulationSettings settings_of(double step, Integrator integrator, const Vector3& gravity) {
  SimulationSettings settings;
  settings.gravity = gravity;
  settings.integrator = integrator;
  settings.time_step = step;
  return settings;
}

JointLaw joint(double friction, bool augmented) {
  JointLaw law;
  law.normal_stiffness = 1e10;
  law.shear_stiffness = 1e10;
  law.friction = friction;
  law.rigid = augmented;
  return law;
}

/// F of a block of order 1.
Eigen::Matrix3d gradient_of(const Simulation& simulation, std::size_t block) {
  return simulation.states()[block].position.transpose() * simulation.blocks()[block].parts()->mean_gradients;
}

class RigidBlock : public testing::TestWithParam<Integrator> {};

TEST_P(RigidBlock, FliesAParabolaExactly) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("stone", Polyhedron(make_box({0, 0, 0}, {1, 2, 3})), rock, 0));
  Simulation simulation(std::move(blocks), {{{3, 0, 4}, Vector3::Zero()}}, same_law(joint(0.5, false)),
                        settings_of(0.05, GetParam(), {0, 0, -10}));
  EXPECT_EQ(simulation.unknowns(), 6);
  ASSERT_TRUE(run_until(simulation, 1.0));
  EXPECT_LT((place_of(simulation, 0, {1, 2, 3}) - Vector3(4, 2, 2)).norm(), 1e-11);
}

/// A block of 1 x 2 x 3 m spinning about its middle axis, which is unstable.
TEST_P(RigidBlock, TumblesAboutItsMiddleAxisAsEulersEquationsSay) {
  const Vector3 half(0.5, 1.0, 1.5);
  const Vector3 start(0.01, 2.0, 0.02);
  const auto fly = [&](double step) {
    std::vector<BlockModel> blocks;
    blocks.emplace_back(block_of("stone", Polyhedron(make_box(-half, half)), rock, 0));
    Simulation simulation(std::move(blocks), {{Vector3::Zero(), start}}, same_law(joint(0.5, false)),
                          settings_of(step, GetParam(), Vector3::Zero()));
    const Vector3 before = simulation.blocks()[0].angular_momentum(simulation.states()[0]);
    const double energy = simulation.blocks()[0].kinetic_energy(simulation.states()[0]);
    EXPECT_TRUE(run_until(simulation, 5.0));
    const BlockState& end = simulation.states()[0];
    EXPECT_LT((simulation.blocks()[0].angular_momentum(end) - before).norm(), 1e-10 * before.norm());
    EXPECT_NEAR(simulation.blocks()[0].kinetic_energy(end), energy, 20.0 * step * step * energy);
    const Eigen::Matrix3d turn = gradient_of(simulation, 0);
    EXPECT_LT((turn.transpose() * turn - Eigen::Matrix3d::Identity()).norm(), 1e-13);
    return turn;
  };
  // R' = R [w]x and I w' = (I w) x w in the frame of the body, by the method of Runge and Kutta.
  const Vector3 moments(4.0 + 9.0, 1.0 + 9.0, 1.0 + 4.0);
  Eigen::Matrix<double, 3, 4> state;
  state << Eigen::Matrix3d::Identity(), start;
  const auto rate = [&](const Eigen::Matrix<double, 3, 4>& at) {
    const Vector3 w = at.col(3);
    Eigen::Matrix3d cross;
    cross << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    Eigen::Matrix<double, 3, 4> result;
    result << at.leftCols<3>() * cross, moments.cwiseProduct(w).cross(w).cwiseQuotient(moments);
    return result;
  };
  constexpr int count = 50000;
  constexpr double h = 5.0 / count;
  for (int k = 0; k < count; ++k) {
    const auto k1 = rate(state);
    const auto k2 = rate(state + 0.5 * h * k1);
    const auto k3 = rate(state + 0.5 * h * k2);
    const auto k4 = rate(state + h * k3);
    state += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  // The turn about the middle axis has left it by then, and the error is of second order.
  EXPECT_LT(state(1, 3), 0.75 * start[1]);
  const double coarse = (fly(0.01) - state.leftCols<3>()).norm();
  const double fine = (fly(0.005) - state.leftCols<3>()).norm();
  EXPECT_LT(fine, 0.02);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
}

/// Down a slope of 30 degrees: s = (sin a - tan(phi) cos a) g t^2 / 2.
TEST_P(RigidBlock, SlidesDownASlope) {
  for (const bool augmented : {false, true}) {
    std::vector<BlockModel> blocks;
    BlockDefinition slope = block_of("slope", tilted_box({-10, -2, -1}, {10, 2, 0}, 30), rock, 1);
    slope.fixed = true;
    blocks.emplace_back(std::move(slope));
    blocks.emplace_back(block_of("stone", tilted_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.5}, 30), rock, 0));
    SimulationSettings settings = settings_of(0.002, GetParam(), {0, 0, -10});
    settings.augmented = augmented;
    Simulation simulation(std::move(blocks), {2, InitialMotion{}},
                          same_law(joint(std::tan(20 * degree), augmented)), settings);
    const Vector3 before = place_of(simulation, 1, {0, 0, 0});
    ASSERT_TRUE(run_until(simulation, 0.4));
    const double travel = (place_of(simulation, 1, {0, 0, 0}) - before).norm();
    const double expected =
        0.5 * 10.0 * 0.16 * (std::sin(30 * degree) - std::tan(20 * degree) * std::cos(30 * degree));
    EXPECT_NEAR(travel, expected, 0.01 * expected);
  }
}

/// A block of 1 x 1 x 4 m let go at 0.6 of the angle at which it would fall: its edge meets the ground after
/// acosh(1 / (1 - 0.6)) / p, p^2 = 3 g / (4 r), for small angles (Housner, 1963); by the pendulum's equation here.
TEST_P(RigidBlock, RocksAsHousnerSays) {
  const double r = std::hypot(0.5, 2.0);
  const double corner = std::atan2(0.5, 2.0);
  const double angle = 0.6 * corner;
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-5, -5, -1}, {5, 5, 0}));
  blocks.emplace_back(block_of("stone", tilted_box({-1, -0.5, 0}, {0, 0.5, 4}, -angle / degree), rock, 0));
  SimulationSettings settings = settings_of(0.001, GetParam(), {0, 0, -10});
  settings.augmented = true;
  Simulation simulation(std::move(blocks), {2, InitialMotion{}}, same_law(joint(10.0, true)), settings);
  // (4/3) r^2 a'' = -g r sin(corner - a): from rest until a = 0.
  double a = angle;
  double rate = 0.0;
  double time = 0.0;
  constexpr double h = 1e-6;
  while (a > 0.0) {
    rate -= h * 0.75 * 10.0 / r * std::sin(corner - a);
    a += h * rate;
    time += h;
  }
  double landed = 0.0;
  double before = 1.0;
  while (landed == 0.0 && !simulation.reached(2.0)) {
    ASSERT_EQ(simulation.step(2.0), StepStatus::accepted);
    double height = 1.0;
    for (const Vector3& point : simulation.blocks()[1].solid().mesh().points)
      if (point[0] < -0.9 && point[2] < 1.0) height = place_of(simulation, 1, point)[2];
    if (height < 1e-4 && before >= 1e-4) landed = simulation.time();
    before = height;
  }
  EXPECT_NEAR(landed, time, 0.01 * time);
}

INSTANTIATE_TEST_SUITE_P(By, RigidBlock, testing::Values(Integrator::dda, Integrator::average_acceleration));

TEST(RigidBlocks, StandOnDeformingOnesWithTheirWeight) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-2, -2, -1}, {2, 2, 0}));
  blocks.emplace_back(block_of("soft", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 1})), rock, 2));
  blocks.emplace_back(block_of("hard", Polyhedron(make_box({-0.5, -0.5, 1}, {0.5, 0.5, 2})), rock, 0));
  SimulationSettings settings = settings_of(0.01, Integrator::dda, {0, 0, -10});
  settings.augmented = true;
  Simulation simulation(std::move(blocks), {3, InitialMotion{}}, same_law(joint(0.5, true)), settings);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(1.0);
  EXPECT_EQ(status, StaticStatus::equilibrium);
  double upper = 0.0;
  double lower = 0.0;
  for (const PairRecord& record : simulation.contacts())
    for (const PointResponse& point : record.responses)
      (record.a == 0 || record.b == 0 ? lower : upper) += point.force[0];
  EXPECT_NEAR(upper, 20000.0, 1e-5 * 20000.0);
  EXPECT_NEAR(lower, 40000.0, 1e-5 * 40000.0);
}

/// Inertia falls as far as with blocks that deform, and no farther: in as many iterations.
TEST(RigidBlocks, ComeToRestInAsManyIterationsAsOthers) {
  std::array<int, 2> iterations{};
  for (const int order : {0, 1}) {
    std::vector<BlockModel> blocks;
    blocks.emplace_back(fixed_box({-2, -2, -1}, {2, 2, 0}));
    blocks.emplace_back(block_of("a", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 1})), rock, order));
    blocks.emplace_back(block_of("b", Polyhedron(make_box({-0.3, -0.5, 1}, {0.7, 0.5, 2})), rock, order));
    SimulationSettings settings = settings_of(0.001, Integrator::dda, {0, 0, -10});
    settings.augmented = true;
    Simulation simulation(std::move(blocks), {3, InitialMotion{}}, same_law(joint(0.5, true)), settings);
    StaticStatus status = StaticStatus::balancing;
    while (status == StaticStatus::balancing) status = simulation.static_step(1.0);
    EXPECT_EQ(status, StaticStatus::equilibrium) << order;
    iterations.at(static_cast<std::size_t>(order)) = static_cast<int>(simulation.steps());
  }
  EXPECT_LE(iterations[0], iterations[1] + 2);
}

TEST(RigidBlocks, GoOnFromASnapshotWithTheSameBits) {
  const auto make = [] {
    std::vector<BlockModel> blocks;
    blocks.emplace_back(fixed_box({-2, -2, -1}, {2, 2, 0}));
    blocks.emplace_back(block_of("soft", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 1})), rock, 2));
    blocks.emplace_back(block_of("hard", tilted_box({-0.5, -0.5, 1.2}, {0.5, 0.5, 2}, 10), rock, 0));
    SimulationSettings settings = settings_of(0.005, Integrator::dda, {0, 0, -10});
    settings.augmented = true;
    const InitialMotion spin{Vector3::Zero(), Vector3(0, 1, 0.5)};
    return Simulation(std::move(blocks), {{}, {}, spin}, same_law(joint(0.5, true)), settings);
  };
  Simulation whole = make();
  ASSERT_TRUE(run_until(whole, 0.15));
  Simulation rest = make();
  rest.restore(whole.snapshot());
  ASSERT_TRUE(run_until(whole, 0.4));
  ASSERT_TRUE(run_until(rest, 0.4));
  SimulationSnapshot expected = whole.snapshot();
  const SimulationSnapshot reached = rest.snapshot();
  // Times of the clock, and what was factorised only to make kept factors again.
  expected.run.log.seconds = reached.run.log.seconds;
  expected.run.log.counts.factors = reached.run.log.counts.factors;
  EXPECT_EQ(to_bytes(reached), to_bytes(expected));
  EXPECT_FALSE(whole.contacts().empty());
}

TEST(RigidBlocks, HaveNoSupportsNoOtherOrderAndNoGeneralizedAlpha) {
  BlockDefinition held = block_of("held", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 0);
  held.supports.push_back({Vector3(0, 0, 0)});
  EXPECT_THROW(BlockModel{held}, std::invalid_argument);
  held.supports.clear();
  const BlockModel block(held);
  EXPECT_THROW((void)block.with_order(1), std::invalid_argument);
  EXPECT_THROW(
      (void)BlockModel(block_of("b", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 1)).with_order(0),
      std::invalid_argument);
  EXPECT_THROW(Simulation({block}, {InitialMotion{}}, same_law(joint(0.5, false)),
                          settings_of(0.01, Integrator::generalized_alpha, Vector3::Zero())),
               std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::rigid_block_test

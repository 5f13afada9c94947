// Runs with quiet faces: momentum and energy that leave, the reaction of rest, checkpoints.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::quiet_boundary_test {
namespace {

using test_support::block_of;
using test_support::place_of;
using test_support::run_static;
using test_support::run_until;
using test_support::same_law;

/// lambda = mu = 8e7 Pa, c_s = 200 m/s.
const Material soil{2000.0, 2e8, 0.25};
const double pressure_speed = 200.0 * std::sqrt(3.0);

BlockDefinition quiet_block(int order, const WaveVelocity& wave = {}) {
  BlockDefinition block = block_of("soil", Polyhedron(make_box({0, 0, 0}, {3, 2, 4})), soil, order);
  const std::vector<int> faces = outer_faces(*block.solid, {{0, 0, 0}, -Vector3::UnitZ()});
  block.quiet.push_back({.where = FaceList{faces}, .driving = wave_loads(*block.solid, faces, soil, wave)});
  return block;
}

/// A block on a quiet base, and one more on it.
Simulation stack(const SimulationSettings& settings, const std::vector<InitialMotion>& motions,
                 const WaveVelocity& wave = {}) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(quiet_block(1, wave));
  if (motions.size() > 1)
    blocks.emplace_back(block_of("top", Polyhedron(make_box({0, 0, 4}, {3, 2, 6})), soil, 1));
  return {std::move(blocks), motions, same_law({1e10, 4e9, 0.6, 0.0, 0.0, true}), settings};
}

SimulationSettings settings_of(Integrator integrator, double time_step) {
  SimulationSettings settings;
  settings.integrator = integrator;
  settings.time_step = time_step;
  settings.gravity.setZero();
  return settings;
}

// The momentum m v0 leaves through rho c_p A times the displacement of the base: u = h v0 / c_p.
TEST(QuietBoundary, MomentumLeavesThroughTheBase) {
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    const double speed = 0.1;
    Simulation simulation = stack(settings_of(integrator, 2e-4), {{{0, 0, -speed}, Vector3::Zero()}});
    const double energy = 0.5 * 2000.0 * 24.0 * speed * speed;
    EXPECT_NEAR(simulation.momentum().z(), -2000.0 * 24.0 * speed, 1e-9);
    ASSERT_TRUE(run_until(simulation, 0.5));
    double sum = 0.0;
    for (const Vector3& corner : {Vector3(0, 0, 0), Vector3(3, 0, 0), Vector3(0, 2, 0), Vector3(3, 2, 0)})
      sum += 0.25 * place_of(simulation, 0, corner).z();
    EXPECT_NEAR(sum / (-4.0 * speed / pressure_speed), 1.0, 0.01);
    EXPECT_NEAR(simulation.momentum().z() / (2000.0 * 24.0 * speed), 0.0, 1e-6);
    const Ledger& ledger = simulation.ledger();
    EXPECT_LT(std::abs(ledger.residual), 1e-12 * energy);
    EXPECT_GT(ledger.damping, (integrator == Integrator::average_acceleration ? 0.999 : 0.5) * energy);
    EXPECT_NEAR((ledger.damping + ledger.numerical) / energy, 1.0, 1e-3);
  }
}

TEST(QuietBoundary, TheReactionOfRestStaysInMotion) {
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    SimulationSettings settings = settings_of(integrator, 1e-3);
    settings.gravity = {0, 0, -10};
    Simulation simulation = stack(settings, {{}, {}});
    ASSERT_EQ(simulation.start_from_statics([] { return true; }), StaticStatus::equilibrium);
    EXPECT_TRUE(simulation.blocks()[0].holds_quiet_faces());
    const Vector3 at_rest = place_of(simulation, 1, {1, 1, 6});
    EXPECT_LT(at_rest.z(), 6.0);
    ASSERT_TRUE(run_until(simulation, 0.1));
    const BlockModel& base = simulation.blocks()[0];
    const Vector3 reaction = std::sqrt(base.basis().volume()) * base.reaction().row(0).transpose();
    // rho g (24 + 12) m^3
    EXPECT_NEAR((reaction - Vector3(0, 0, 7.2e5)).norm(), 0.0, 1e-3);
    // The acceleration that generalized-alpha carries does not know the force of the contact.
    const double still = (integrator == Integrator::generalized_alpha ? 2e-5 : 1e-9) * (6.0 - at_rest.z());
    EXPECT_NEAR((place_of(simulation, 1, {1, 1, 6}) - at_rest).norm(), 0.0, still);
    EXPECT_NEAR(place_of(simulation, 0, {1, 1, 0}).z(), 0.0, still);
    // Statics hold the base again.
    EXPECT_EQ(run_static(simulation, 0.1), StaticStatus::equilibrium);
    EXPECT_TRUE(simulation.blocks()[0].holds_quiet_faces());
  }
}

// Stress of the ground that the base holds: sigma_zz = -rho g (4 - z), nothing else.
TEST(QuietBoundary, StressOfTheGroundNeedsNoStaticAnalysis) {
  BlockDefinition block = quiet_block(2);
  block.initial_stress = [](const Vector3& place) {
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
    stress(2, 2) = -2000.0 * 10.0 * (4.0 - place.z());
    return stress;
  };
  SimulationSettings settings = settings_of(Integrator::average_acceleration, 1e-3);
  settings.gravity = {0, 0, -10};
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(block));
  Simulation simulation(std::move(blocks), {{}}, same_law({}), settings);
  ASSERT_TRUE(run_until(simulation, 0.1));
  EXPECT_NEAR((place_of(simulation, 0, {1, 1, 4}) - Vector3(1, 1, 4)).norm(), 0.0, 1e-12);
}

WaveVelocity shear_wave() {
  WaveVelocity wave;
  wave[0] = {{0.0, 0.02, 0.04}, {0.0, 0.1, 0.0}};
  return wave;
}

TEST(QuietBoundary, ResumedRunsTakeTheSameSteps) {
  for (const Integrator integrator : {Integrator::dda, Integrator::generalized_alpha}) {
    SimulationSettings settings = settings_of(integrator, 1e-3);
    settings.gravity = {0, 0, -10};
    const auto make = [&] { return stack(settings, {{}, {}}, shear_wave()); };
    Simulation whole = make();
    ASSERT_EQ(whole.start_from_statics([] { return true; }), StaticStatus::equilibrium);
    ASSERT_TRUE(run_until(whole, 0.02));
    const std::string bytes = to_bytes(whole.snapshot());
    Simulation resumed = make();
    resumed.restore(snapshot_from_bytes(bytes));
    EXPECT_FALSE(resumed.blocks()[0].holds_quiet_faces());
    EXPECT_EQ(to_bytes(resumed.snapshot()), bytes);
    ASSERT_TRUE(run_until(whole, 0.04));
    ASSERT_TRUE(run_until(resumed, 0.04));
    EXPECT_EQ(whole.states()[0].position, resumed.states()[0].position);
    EXPECT_EQ(whole.states()[1].velocity, resumed.states()[1].velocity);
    // Back to rest as placed.
    Simulation placed = make();
    resumed.restore(placed.snapshot());
    EXPECT_TRUE(resumed.blocks()[0].holds_quiet_faces());
  }
}

TEST(QuietBoundary, TheNextStageGoesOnFromTheReaction) {
  SimulationSettings settings = settings_of(Integrator::average_acceleration, 1e-3);
  settings.gravity = {0, 0, -10};
  Simulation first = stack(settings, {{}, {}});
  ASSERT_EQ(run_static(first, 1.0), StaticStatus::equilibrium);
  Simulation second = stack(settings, {{}, {}});
  second.start_stage(first.snapshot(), {false, false});
  const Vector3 at_rest = place_of(second, 1, {1, 1, 6});
  ASSERT_TRUE(run_until(second, 0.02));
  Simulation third = stack(settings, {{}, {}});
  third.start_stage(second.snapshot(), {false, false});
  EXPECT_EQ(third.blocks()[0].reaction(), second.blocks()[0].reaction());
  ASSERT_TRUE(run_until(third, 0.05));
  EXPECT_NEAR((place_of(third, 1, {1, 1, 6}) - at_rest).norm(), 0.0, 1e-6 * (6.0 - at_rest.z()));
}

TEST(QuietBoundary, ASleepingBlockIsWokenByItsWave) {
  WaveVelocity wave;
  wave[0] = {{0.5, 0.52, 0.54}, {0.0, 0.1, 0.0}};
  Simulation simulation = stack(settings_of(Integrator::dda, 1e-3), {{}}, wave);
  ASSERT_TRUE(run_until(simulation, 0.49));
  EXPECT_EQ(simulation.counts().islands_put_to_sleep, 1U);
  EXPECT_NEAR((place_of(simulation, 0, {1, 1, 0}) - Vector3(1, 1, 0)).norm(), 0.0, 1e-14);
  ASSERT_TRUE(run_until(simulation, 0.54));
  EXPECT_GT(place_of(simulation, 0, {1, 1, 0}).x() - 1.0, 1e-3);
}

// A load of the first instant is no reaction: once its wave has passed the block moves with p / (rho c_p) throughout.
TEST(QuietBoundary, ALoadFromTheFirstInstantMovesTheBase) {
  const Material bar{2000.0, 2e8, 0.0};
  const double speed = std::sqrt(2e8 / 2000.0), pressure = 1e4;
  for (const int order : {1, 2, 3}) {
    for (const Integrator integrator :
         {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
      BlockDefinition block = block_of("bar", Polyhedron(make_box({0, 0, 0}, {1, 1, 5})), bar, order);
      block.quiet.push_back({.where = FaceList{outer_faces(*block.solid, {{0, 0, 0}, -Vector3::UnitZ()})}});
      Load& load = block.loads.emplace_back();
      load.where = FaceList{outer_faces(*block.solid, {{0, 0, 5}, Vector3::UnitZ()})};
      load.vector = {0, 0, -pressure};
      std::vector<BlockModel> blocks;
      blocks.emplace_back(std::move(block));
      Simulation simulation(std::move(blocks), {{}}, same_law({1e10, 4e9, 0.6, 0.0, 0.0, true}),
                            settings_of(integrator, 5e-4));
      ASSERT_TRUE(run_until(simulation, 0.5));
      const double before = place_of(simulation, 0, {0.5, 0.5, 0.0}).z();
      ASSERT_TRUE(run_until(simulation, 1.0));
      const double velocity = (place_of(simulation, 0, {0.5, 0.5, 0.0}).z() - before) / 0.5;
      EXPECT_NEAR(velocity / (-pressure / (2000.0 * speed)), 1.0, 0.01) << order;
    }
  }
}

TEST(QuietBoundary, ABlockAsPlacedWithoutForcesStays) {
  Simulation simulation = stack(settings_of(Integrator::dda, 1e-3), {{}});
  ASSERT_TRUE(run_until(simulation, 0.01));
  EXPECT_TRUE(simulation.blocks()[0].reaction().isZero(1e-6));
  EXPECT_NEAR((place_of(simulation, 0, {1, 1, 4}) - Vector3(1, 1, 4)).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace ashlar::quiet_boundary_test

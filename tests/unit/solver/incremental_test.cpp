// Blocks of the incremental formulation in the same solver as those of the total one.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "solver/run/checkpoint.hpp"
#include "support/sample_solids.hpp"
#include "support/simulations.hpp"

namespace ashlar::incremental_test {
namespace {

using test_support::block_of;
using test_support::run_until;
using test_support::same_law;

BlockDefinition incremental(const std::string& name, Polyhedron solid, const Material& material, int order) {
  BlockDefinition definition = block_of(name, std::move(solid), material, order);
  definition.formulation = Formulation::incremental;
  return definition;
}

/// Place of a corner.
Vector3 corner(const Simulation& simulation, std::size_t block, const Vector3& reference) {
  return simulation.blocks()[block].motion_of(simulation.states()[block], reference).place;
}

TEST(Incremental, FreeFallIsExact) {
  for (const int order : {1, 3}) {
    SimulationSettings settings;
    settings.time_step = 0.01;
    std::vector<BlockModel> blocks;
    blocks.emplace_back(incremental("A", test_support::l_shaped_prism(), {2000, 1e9, 0.2}, order));
    Simulation simulation(std::move(blocks), {{}}, same_law({}), settings);
    ASSERT_TRUE(run_until(simulation, 1.0));
    const Vector3 fall = corner(simulation, 0, {2, 1, 1}) - Vector3(2, 1, 1);
    EXPECT_NEAR(fall.z(), -0.5 * 9.81, 1e-10) << order;
    EXPECT_NEAR(fall.head<2>().norm(), 0.0, 1e-10) << order;
  }
}

TEST(Incremental, EveryStepOfATurnAddsVolume) {
  // Each step maps by I + t [e_z]x, of determinant 1 + t^2.
  for (const int order : {1, 2}) {
    SimulationSettings settings;
    settings.gravity.setZero();
    settings.time_step = 0.02;
    std::vector<BlockModel> blocks;
    blocks.emplace_back(incremental("A", Polyhedron(make_box({0, 0, 0}, {1, 2, 3})), {1, 1e9, 0.2}, order));
    Simulation simulation(std::move(blocks), {{Vector3::Zero(), {0, 0, 1}}}, same_law({}), settings);
    ASSERT_TRUE(run_until(simulation, 1.0));
    EXPECT_NEAR(simulation.blocks()[0].basis().volume() / 6.0, std::pow(1.0 + 4e-4, 50), 1e-10) << order;
  }
}

TEST(Incremental, SupportsThatMoveTakeTheBlockAlong) {
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.time_step = 0.01;
  std::vector<BlockModel> blocks;
  BlockDefinition block = incremental("A", Polyhedron(make_box({0, 0, 0}, {4, 1, 1})), {1000, 1e7, 0.2}, 2);
  block.supports.push_back({Plane{{0, 0, 0}, {-1, 0, 0}}});
  block.supports.back().history = {{0.0, 0.5}, {Vector3::Zero(), Vector3(0.1, 0, 0.2)}};
  blocks.push_back(BlockModel(std::move(block)));
  Simulation simulation(std::move(blocks), {{}}, same_law({}), settings);
  ASSERT_TRUE(run_until(simulation, 0.5));
  EXPECT_NEAR((corner(simulation, 0, {0, 1, 1}) - Vector3(0.1, 1, 1.2)).norm(), 0.0, 1e-12);
}

TEST(Incremental, ACubeSlidesDownAnIncline) {
  // g/2 (sin a - cos a tan phi) t^2 with a = 30, phi = 20 degrees, t = 1 s: case of record.
  for (const bool area : {true, false}) {
    std::vector<BlockModel> blocks;
    BlockDefinition floor =
        block_of("floor", test_support::tilted_box({-6, -2, -1}, {2, 2, 0}, 30.0), {2500, 5e9, 0.2}, 1);
    floor.fixed = true;
    blocks.emplace_back(std::move(floor));
    blocks.emplace_back(incremental("cube", test_support::tilted_box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, 30.0),
                                    {2500, 5e9, 0.2}, 1));
    const double friction = std::tan(20.0 * std::numbers::pi / 180.0);
    SimulationSettings settings;
    settings.time_step = 1e-3;
    settings.area_springs = area;
    settings.curved_surface = false;
    Simulation simulation(std::move(blocks), {{}, {}}, same_law({1e10, 5e9, friction, 0, 0, area}), settings);
    const Vector3 first = simulation.blocks()[1].basis().centroid();
    ASSERT_TRUE(run_until(simulation, 1.0));
    const Vector3 travel = simulation.blocks()[1].basis().centroid() - first;
    EXPECT_NEAR(travel.norm(), 0.9064074, 0.005 * 0.9064074) << area;
    EXPECT_GT(simulation.report().sliding, 0);
  }
}

TEST(Incremental, AClampedBeamSettlesWhereItsLoadIsBalanced) {
  // nu = 0, small deflection: the cantilever of record, order 2, w = 0.146914560 * 1e9 / E.
  const double modulus = 1e13;
  BlockDefinition beam =
      incremental("beam", Polyhedron(make_box({0, -1.5, -0.5}, {8, 1.5, 0.5})), {3600, modulus, 0.0}, 2);
  beam.supports.push_back({Plane{{0, 0, 0}, {1, 0, 0}}});
  beam.followed.push_back({8, 0, 0});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(beam));
  SimulationSettings settings;
  Simulation simulation(std::move(blocks), {{}}, same_law({}), settings);
  simulation.settle_supported_blocks();
  const double expected = -0.146914560 * 1e9 / modulus;
  EXPECT_NEAR(corner(simulation, 0, {8, 0, 0}).z(), expected, 1e-5 * std::abs(expected));
  ASSERT_TRUE(run_until(simulation, 0.05));
  EXPECT_NEAR(corner(simulation, 0, {8, 0, 0}).z(), expected, 1e-5 * std::abs(expected));
}

/// A soft block of order 2 that slides on a clamped one.
Simulation stone_on_beam(Integrator integrator) {
  const Material material{2000.0, 2e7, 0.25};
  std::vector<BlockModel> blocks;
  blocks.emplace_back(
      incremental("stone", Polyhedron(make_box({0.5, 0.1, 0.502}, {1.5, 0.9, 1.0})), material, 2));
  BlockDefinition beam = incremental("beam", Polyhedron(make_box({0, 0, 0}, {2, 1, 0.5})), material, 2);
  beam.supports.push_back({Plane{Vector3::Zero(), Vector3::UnitX()}});
  beam.followed.push_back({1.9, 0.4, 0.2});
  blocks.emplace_back(std::move(beam));
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.integrator = integrator;
  return {std::move(blocks),
          {{{0.4, 0.0, -0.3}, Vector3::Zero()}, {}},
          same_law({1e9, 1e9, 0.2, 0, 0, true}),
          settings};
}

TEST(Incremental, ResumedSimulationGoesOnBitForBit) {
  for (const Integrator integrator : {Integrator::dda, Integrator::generalized_alpha}) {
    Simulation straight = stone_on_beam(integrator);
    const auto take_steps = [](Simulation& simulation) {
      for (int k = 0; k < 15; ++k) ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
    };
    take_steps(straight);
    ASSERT_GT(straight.report().locked + straight.report().sliding, 0) << "not cut in the middle of contact";
    const std::string bytes = to_bytes(straight.snapshot());
    take_steps(straight);
    Simulation resumed = stone_on_beam(integrator);
    resumed.restore(snapshot_from_bytes(bytes));
    EXPECT_EQ(to_bytes(resumed.snapshot()), bytes);
    take_steps(resumed);
    SimulationSnapshot expected = straight.snapshot();
    SimulationSnapshot reached = resumed.snapshot();
    expected.run.log.seconds = reached.run.log.seconds;
    expected.run.log.counts.factors = reached.run.log.counts.factors;
    EXPECT_EQ(to_bytes(reached), to_bytes(expected));
  }
}

TEST(Incremental, StaticAnalysisIsRefused) {
  Simulation simulation = stone_on_beam(Integrator::dda);
  EXPECT_THROW((void)simulation.static_step(1.0), std::logic_error);
}

}  // namespace
}  // namespace ashlar::incremental_test

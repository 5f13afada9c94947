#include "solver/run/checkpoint.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/solid/shapes.hpp"
#include "support/simulations.hpp"

namespace ashlar::checkpoint_test {
namespace {

/// A bending block on an elastic one that is clamped at an end; it slides, and both are dented.
Simulation make_simulation(LinearMethod method = LinearMethod::cholesky,
                           double chord_tolerance = SearchSettings().chord_tolerance) {
  const Material material{2000.0, 2e7, 0.25};
  std::vector<BlockModel> blocks;
  blocks.emplace_back(test_support::block_of(
      "stone", Polyhedron(make_box(Vector3(0.5, 0.1, 0.502), Vector3(1.5, 0.9, 1.0))), material, 2));
  BlockDefinition beam = test_support::block_of(
      "beam", Polyhedron(make_box(Vector3(0.0, 0.0, 0.0), Vector3(2.0, 1.0, 0.5))), material, 2);
  beam.supports.push_back({Plane{Vector3::Zero(), Vector3::UnitX()}, {true, true, true}});
  blocks.emplace_back(std::move(beam));
  const JointLaw law{1e9, 1e9, 0.2, 0.0, 0.0, true};
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.linear_method = method;
  settings.search.chord_tolerance = chord_tolerance;
  return {std::move(blocks),
          {{Vector3(0.4, 0.0, -0.3), Vector3::Zero()}, {Vector3::Zero(), Vector3::Zero()}},
          test_support::same_law(law),
          settings};
}

constexpr double end_time = 1.0;
constexpr int steps_before = 30;
constexpr int steps_after = 30;

void take_steps(Simulation& simulation, int count) {
  for (int k = 0; k < count; ++k) ASSERT_EQ(simulation.step(end_time), StepStatus::accepted);
}

// More than a sink is given at once, after something else and before it.
TEST(Checkpoint, ASinkIsGivenTheSameBytesInPieces) {
  Simulation simulation = make_simulation();
  take_steps(simulation, 2);
  const SimulationSnapshot snapshot = simulation.snapshot();
  std::string bytes;
  int pieces = 0;
  ByteWriter writer([&](std::string_view piece) {
    bytes += piece;
    ++pieces;
  });
  const std::vector<double> large(20'000, 0.5);
  writer(large);
  write_snapshot(writer, snapshot);
  writer(7);
  EXPECT_GT(pieces, 1);
  writer.flush();
  ByteReader reader(bytes);
  std::vector<double> first;
  reader(first);
  EXPECT_EQ(first, large);
  EXPECT_EQ(to_bytes(read_snapshot(reader)), to_bytes(snapshot));
  int last = 0;
  reader(last);
  EXPECT_EQ(last, 7);
  EXPECT_TRUE(reader.at_end());
}

TEST(Checkpoint, FactorsOfLoadsGoAlong) {
  BlockDefinition cube =
      test_support::block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2000.0, 1e9, 0.0}, 1);
  cube.loads.push_back({Vector3(0.5, 0.5, 0.5), false, Vector3(2000.0, 0.0, 0.0), {}});
  const auto make = [&] {
    SimulationSettings settings;
    settings.gravity = Vector3::Zero();
    settings.time_step = 1e-3;
    return Simulation({BlockModel(cube)}, {{}}, test_support::same_law({}), settings);
  };
  Simulation straight = make();
  straight.set_load_factor(0, 0, 3.0);
  take_steps(straight, 1);
  Simulation resumed = make();
  resumed.restore(snapshot_from_bytes(to_bytes(straight.snapshot())));
  take_steps(resumed, 1);
  // 3 m/s^2 for 2 ms, in the zeroth coefficient of a unit volume.
  EXPECT_NEAR(resumed.states()[0].velocity(0, 0), 6e-3, 1e-15);
  // A snapshot without factors takes them back.
  resumed.restore(make().snapshot());
  take_steps(resumed, 1);
  EXPECT_NEAR(resumed.states()[0].velocity(0, 0), 1e-3, 1e-15);
}

class CheckpointOfSolver : public ::testing::TestWithParam<LinearMethod> {};

TEST_P(CheckpointOfSolver, ResumedSimulationGoesOnBitForBit) {
  Simulation straight = make_simulation(GetParam());
  take_steps(straight, steps_before);
  ASSERT_GT(straight.report().locked + straight.report().sliding, 0) << "not cut in the middle of contact";
  const std::string bytes = to_bytes(straight.snapshot());
  take_steps(straight, steps_after);

  Simulation resumed = make_simulation(GetParam());
  resumed.restore(snapshot_from_bytes(bytes));
  EXPECT_EQ(to_bytes(resumed.snapshot()), bytes);
  take_steps(resumed, steps_after);

  SimulationSnapshot expected = straight.snapshot();
  SimulationSnapshot reached = resumed.snapshot();
  // Times differ, and repeated factorisations are counted again.
  expected.run.log.seconds = reached.run.log.seconds;
  expected.run.log.counts.factors = reached.run.log.counts.factors;
  EXPECT_EQ(to_bytes(reached), to_bytes(expected));
}
INSTANTIATE_TEST_SUITE_P(All, CheckpointOfSolver,
                         ::testing::Values(LinearMethod::cholesky, LinearMethod::conjugate_gradients));

// A run resumed from its end takes no step before depths are measured.
TEST(Checkpoint, FacesThatCurveAreDividedAsTheyWere) {
  constexpr double chord_tolerance = 1e-4;  // m
  Simulation straight = make_simulation(LinearMethod::cholesky, chord_tolerance);
  take_steps(straight, steps_before);
  Simulation resumed = make_simulation(LinearMethod::cholesky, chord_tolerance);
  const auto points = [](const Simulation& simulation) {
    return simulation.finder().surfaces()[1].surface().points;
  };
  ASSERT_GT(points(straight).size(), points(resumed).size()) << "the beam is not divided";
  resumed.restore(straight.snapshot());
  EXPECT_EQ(points(resumed), points(straight));
  EXPECT_FALSE(straight.audit());
  EXPECT_FALSE(resumed.audit());
  EXPECT_EQ(resumed.deepest().depth, straight.deepest().depth);
  EXPECT_EQ(resumed.deepest().place, straight.deepest().place);
}

/// Three cubes of order 4 on each other: a new factor costs 40 solutions with it.
Simulation make_stack() {
  std::vector<BlockModel> blocks;
  BlockDefinition floor =
      test_support::block_of("floor", Polyhedron(make_box({-5, -5, -1}, {5, 5, 0})), {2500, 1e8, 0.2}, 1);
  floor.fixed = true;
  blocks.emplace_back(std::move(floor));
  std::vector<InitialMotion> motions(1);
  for (int k = 0; k < 3; ++k) {
    const double low = k;
    blocks.emplace_back(test_support::block_of("cube" + std::to_string(k),
                                               Polyhedron(make_box({-0.5, -0.5, low}, {0.5, 0.5, low + 1})),
                                               {2500, 1e8, 0.2}, 4));
    motions.emplace_back();
  }
  SimulationSettings settings;
  settings.time_step = 2e-3;
  settings.rest.sleeps = false;
  return {std::move(blocks), motions, test_support::same_law({1e9, 1e9, 0.5, 0.0, 0.0, true}), settings};
}

// The next step solves with a factor of an earlier one, so that a resumed run needs the same factor.
TEST(Checkpoint, AFactorOfAnEarlierStepIsMadeAgain) {
  Simulation straight = make_stack();
  take_steps(straight, steps_before);
  const std::uint64_t factorizations = straight.counts().factors.factorizations;
  const SimulationSnapshot snapshot = straight.snapshot();
  ASSERT_EQ(snapshot.factors.size(), 1U);
  take_steps(straight, steps_after);
  EXPECT_LT(straight.counts().factors.factorizations, factorizations + steps_after) << "none was used again";

  Simulation resumed = make_stack();
  resumed.restore(snapshot_from_bytes(to_bytes(snapshot)));
  take_steps(resumed, steps_after);
  EXPECT_EQ(resumed.counts().factors.factorizations, straight.counts().factors.factorizations);
  SimulationSnapshot expected = straight.snapshot();
  expected.run.log.seconds = resumed.snapshot().run.log.seconds;
  expected.run.log.counts.factors = resumed.snapshot().run.log.counts.factors;
  EXPECT_EQ(to_bytes(resumed.snapshot()), to_bytes(expected));
}

TEST(Checkpoint, AFactorOfNoIslandIsRefused) {
  Simulation simulation = make_stack();
  take_steps(simulation, 5);
  SimulationSnapshot snapshot = simulation.snapshot();
  ASSERT_EQ(snapshot.factors.size(), 1U);
  snapshot.factors[0].values.pop_back();
  Simulation other = make_stack();
  const std::string before = to_bytes(other.snapshot());
  EXPECT_THROW(other.restore(snapshot), std::invalid_argument);
  snapshot.factors[0].pairs[0] = {2, 7};
  EXPECT_THROW(other.restore(snapshot), std::invalid_argument);
  EXPECT_EQ(to_bytes(other.snapshot()), before) << "it was changed all the same";
}

TEST(Checkpoint, EverySnapshotMemberIsStored) {
  SimulationSnapshot snapshot;
  RunState& run = snapshot.run;
  run.clock = {0.1, 0.25, 14};
  run.next_step = 1e-300;
  run.steps = 7;
  run.states = {{Eigen::MatrixX3d::Constant(4, 3, -0.0), Eigen::MatrixX3d::Constant(4, 3, 2.5)}};
  PairHistory& pair = run.pairs[{0, 1}];
  pair.memory =
      ContactMemory({{Vector3(1, 2, 3),
                      Vector3(-1, -2, -3),
                      4,
                      5,
                      Vector3(0, 0, 1),
                      0.5,
                      {Vector3(6, 7, 8), ContactState::sliding, true, 20.0, Vector3(21, 22, 23), 27.0, 26.0,
                       Vector3(36, 37, 38), true, 43.0, 44.0}}},
                    {{28, 29, true, Vector3(30, 31, 32), Vector3(33, 34, 35)}}, 9, {24.0, 25.0}, 27);
  pair.work = 10.0;
  pair.spent = 39.0;
  pair.depth = 40.0;
  run.pairs[{1, 2}].clearance = Clearance{41.0, 42.0};
  run.log.rejections = {{11.0, 12.0, RejectionReason::not_positive_definite}};
  run.log.counts.factors.solves = 13;
  const SimulationSnapshot from_bytes = snapshot_from_bytes(to_bytes(snapshot));
  const RunState& back = from_bytes.run;
  EXPECT_EQ(back.clock.start, 0.1);
  EXPECT_EQ(back.clock.step, 0.25);
  EXPECT_EQ(back.clock.count, 14);
  EXPECT_EQ(back.next_step, 1e-300);
  EXPECT_EQ(back.steps, 7);
  ASSERT_EQ(back.states.size(), 1U);
  EXPECT_TRUE(std::signbit(back.states[0].position(3, 2)));
  EXPECT_EQ(back.states[0].velocity(0, 1), 2.5);
  ASSERT_EQ(back.pairs.size(), 2U);
  const PairHistory& touching = back.pairs.at({0, 1});
  EXPECT_FALSE(touching.clearance);
  EXPECT_EQ(touching.work, 10.0);
  EXPECT_EQ(touching.spent, 39.0);
  EXPECT_EQ(touching.depth, 40.0);
  ASSERT_TRUE(back.pairs.at({1, 2}).clearance);
  EXPECT_EQ(back.pairs.at({1, 2}).clearance->distance, 41.0);
  EXPECT_EQ(back.pairs.at({1, 2}).clearance->path, 42.0);
  const ContactMemory& memory = touching.memory;
  ASSERT_EQ(memory.entries().size(), 1U);
  const ContactMemory::Entry& entry = memory.entries()[0];
  EXPECT_EQ(entry.material_a, Vector3(1, 2, 3));
  EXPECT_EQ(entry.material_b, Vector3(-1, -2, -3));
  EXPECT_EQ(entry.face_b, 5);
  EXPECT_EQ(entry.normal, Vector3(0, 0, 1));
  EXPECT_EQ(entry.area, 0.5);
  EXPECT_EQ(entry.memory.normal_multiplier, 20.0);
  EXPECT_EQ(entry.memory.shear_multiplier, Vector3(21, 22, 23));
  EXPECT_EQ(entry.memory.slip, Vector3(6, 7, 8));
  EXPECT_EQ(entry.memory.state, ContactState::sliding);
  EXPECT_TRUE(entry.memory.intact);
  EXPECT_EQ(entry.memory.deferred_friction, 27.0);
  EXPECT_EQ(entry.memory.compression, 26.0);
  EXPECT_EQ(entry.memory.level_slip, Vector3(36, 37, 38));
  EXPECT_TRUE(entry.memory.in_level);
  EXPECT_EQ(entry.memory.dilation, 43.0);
  EXPECT_EQ(entry.memory.level_dilation, 44.0);
  EXPECT_EQ(memory.most_dilation(), 43.0);
  ASSERT_EQ(memory.cuts().size(), 1U);
  EXPECT_EQ(memory.cuts()[0].cell_b, 29);
  EXPECT_TRUE(memory.cuts()[0].of_a);
  EXPECT_EQ(memory.cuts()[0].end, Vector3(33, 34, 35));
  EXPECT_EQ(memory.deepest(), 9.0);
  EXPECT_EQ(memory.bulge(), 27.0);
  EXPECT_EQ(memory.held().normal, 24.0);
  EXPECT_EQ(memory.held().shear, 25.0);
  ASSERT_EQ(back.log.rejections.size(), 1U);
  EXPECT_EQ(back.log.rejections[0].reason, RejectionReason::not_positive_definite);
  EXPECT_EQ(back.log.counts.factors.solves, 13U);
}

TEST(Checkpoint, BytesThatEndTooEarlyAreRefused) {
  const std::string bytes = to_bytes(make_simulation().snapshot());
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 1}) {
    EXPECT_THROW((void)snapshot_from_bytes(bytes.substr(0, size)), std::runtime_error) << size;
  }
  EXPECT_THROW((void)snapshot_from_bytes(bytes + '\0'), std::runtime_error);
}

TEST(Checkpoint, SnapshotOfOtherBlocksIsRefused) {
  Simulation simulation = make_simulation();
  SimulationSnapshot snapshot = simulation.snapshot();
  snapshot.run.states.pop_back();
  EXPECT_THROW(simulation.restore(snapshot), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::checkpoint_test

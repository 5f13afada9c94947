#include "solver/fracture/divided_run.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar::divided_run_test {
namespace {

constexpr double strength = 1e6, young = 1e9;

JointLaw joint() {
  JointLaw law{1e14, 1e14, 0.5, 4.0 * strength, strength, true};
  law.fracture = {100.0, 400.0};
  return law;
}

/// A free beam of order 3 that turns, flies and bends.
Simulation flying_beam() {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(
      test_support::block_of("beam", Polyhedron(make_box({0, 0, 0}, {4, 1, 1})), {2500, young, 0.2}, 3));
  SimulationSettings settings;
  settings.time_step = 1e-3;
  Simulation run(std::move(blocks), {{Vector3(1, 2, 3), Vector3(0.3, -0.2, 0.5)}},
                 test_support::same_law(joint()), settings);
  SimulationSnapshot snapshot = run.snapshot();
  BlockState& state = snapshot.run.states[0];
  for (Eigen::Index k = 4; k < state.position.rows(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      state.position(k, axis) = 1e-5 * static_cast<double>((7 * k + 3 * axis) % 11 - 5);
      state.velocity(k, axis) = 1e-2 * static_cast<double>((5 * k + axis) % 7 - 3);
    }
  snapshot.run.ledger.start(run.system(), snapshot.run.states);
  run.restore(snapshot);
  return run;
}

struct Divided {
  Simulation before, after;
  std::vector<BlockPart> parts;
};

Divided divided(Simulation run, const Plane& plane) {
  BlockDefinition whole = test_support::block_of("beam", run.blocks()[0].solid(), run.blocks()[0].material(),
                                                 run.blocks()[0].order());
  const auto solids = divided_solid(*whole.solid, plane, 0.1);
  std::vector<BlockPart> parts =
      parts_of(whole, *solids, {name_of_part("beam", 1, 0), name_of_part("beam", 1, 1)});
  const PartNumbers numbers{0, {0, 1}};
  Simulation after = with_parts(run, numbers, parts, test_support::same_law(joint()));
  after.restore(divided_state(run, numbers, parts, joint(), after));
  return {std::move(run), std::move(after), std::move(parts)};
}

TEST(DividedRun, PartsHaveTheMotionOfTheBlock) {
  const auto [before, after, parts] =
      divided(flying_beam(), {{1.3, 0.4, 0.5}, Vector3(3, 0.4, -0.2).normalized()});
  ASSERT_EQ(after.blocks().size(), 2U);
  EXPECT_EQ(after.blocks()[0].name(), "beam.crack1.a");
  EXPECT_EQ(after.blocks()[1].name(), "beam.crack1.b");
  EXPECT_NEAR(after.blocks()[0].basis().volume() + after.blocks()[1].basis().volume(), 4.0, 1e-14);
  for (const std::size_t part : {0U, 1U})
    for (const Vector3& point : after.blocks()[part].solid().mesh().points) {
      const PointMotion whole = before.blocks()[0].motion_of(before.states()[0], point);
      const PointMotion moved = after.blocks()[part].motion_of(after.states()[part], point);
      EXPECT_LT((whole.place - moved.place).norm(), 1e-14);
      EXPECT_LT((whole.velocity - moved.velocity).norm(), 1e-12);
    }
  EXPECT_LT((before.momentum() - after.momentum()).norm(), 1e-12 * before.momentum().norm());
  EXPECT_LT((before.angular_momentum() - after.angular_momentum()).norm(),
            1e-12 * before.angular_momentum().norm());
}

TEST(DividedRun, TheLedgerClosesInTheNextSteps) {
  auto [before, after, parts] = divided(flying_beam(), {{1.3, 0.4, 0.5}, Vector3(3, 0.4, -0.2).normalized()});
  EXPECT_NEAR(after.ledger().kinetic, before.ledger().kinetic, 1e-12 * before.ledger().kinetic);
  ASSERT_TRUE(test_support::run_until(after, 0.01));
  EXPECT_LT(std::abs(after.ledger().residual), 1e-11 * after.largest_energy());
}

/// A bar held at one end and pulled at the other one, in equilibrium.
Simulation pulled_bar(double traction) {
  BlockDefinition bar =
      test_support::block_of("beam", Polyhedron(make_box({0, 0, 0}, {4, 1, 1})), {2500, young, 0.0}, 2);
  bar.supports.push_back({Plane{{0, 0, 0}, Vector3::UnitX()}, {true, true, true}, {}});
  bar.loads.push_back({Plane{{4, 0, 0}, Vector3::UnitX()}, true, Vector3(traction, 0, 0), {}});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(bar);
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.time_step = 1e-3;
  Simulation run(std::move(blocks), {{}}, test_support::same_law(joint()), settings);
  EXPECT_EQ(run.settle_supported_blocks().size(), 1U);
  EXPECT_EQ(run.step(1e-3), StepStatus::accepted);
  BlockDefinition whole = bar;
  const auto solids = divided_solid(*whole.solid, {{1, 0.5, 0.5}, Vector3::UnitX()}, 0.1);
  std::vector<BlockPart> parts = parts_of(whole, *solids, {"a", "b"});
  EXPECT_EQ(parts[0].definition.supports.size(), 1U);
  EXPECT_TRUE(parts[1].definition.supports.empty());
  EXPECT_EQ(parts[1].loads, std::vector<int>{0});
  const PartNumbers numbers{0, {0, 1}};
  Simulation after = with_parts(run, numbers, parts, test_support::same_law(joint()));
  after.restore(divided_state(run, numbers, parts, joint(), after));
  return after;
}

TEST(DividedRun, TheJointBeginsWithTheTractionThatWasThere) {
  Simulation run = pulled_bar(0.9 * strength);
  ASSERT_EQ(run.step(2e-3), StepStatus::accepted);
  ASSERT_EQ(run.contacts().size(), 1U);
  Vector3 force = force_on_a(run.contacts().front());
  EXPECT_NEAR(force.x(), 0.9 * strength, 1e-6 * strength);
  // Nothing moves: without the traction the free part would have 360 m/s^2.
  for (const BlockState& state : run.states()) EXPECT_LT(state.velocity.norm(), 1e-9);
  EXPECT_EQ(run.ledger().friction, 0.0);
}

TEST(DividedRun, SolidsOfPartsFitTogether) {
  const Polyhedron box(make_box({0, 0, 0}, {4, 1, 1}));
  const auto solids = divided_solid(box, {{1, 0.5, 0.5}, Vector3::UnitX()}, 0.1);
  ASSERT_TRUE(solids);
  ASSERT_EQ(solids->parts.size(), 2U);
  EXPECT_EQ(solids->parts[0]->volume(), 1.0);
  EXPECT_EQ(solids->parts[1]->volume(), 3.0);
  EXPECT_EQ(solids->area, 1.0);
  EXPECT_FALSE(divided_solid(box, {{5, 0.5, 0.5}, Vector3::UnitX()}, 0.1));
}

TEST(DividedRun, APlaneIsMovedToHaveRoomOnBothSides) {
  const Polyhedron box(make_box({0, 0, 0}, {4, 1, 1}));
  const auto near_the_end = plane_with_room(box, {{3.9, 0.5, 0.5}, Vector3::UnitX()}, 0.5);
  ASSERT_TRUE(near_the_end);
  EXPECT_EQ(near_the_end->point.x(), 3.5);
  EXPECT_EQ(plane_with_room(box, {{2, 0.5, 0.5}, Vector3::UnitX()}, 0.5)->point.x(), 2.0);
  EXPECT_FALSE(plane_with_room(box, {{2, 0.5, 0.5}, Vector3::UnitZ()}, 0.6));
}

TEST(DividedRun, PartsAreNamedByLetters) {
  EXPECT_EQ(name_of_part("beam", 1, 0), "beam.crack1.a");
  EXPECT_EQ(name_of_part("beam.crack1.a", 3, 25), "beam.crack1.a.crack3.z");
  EXPECT_EQ(name_of_part("beam", 2, 26), "beam.crack2.aa");
}

}  // namespace
}  // namespace ashlar::divided_run_test

// Bolts and props between blocks that several ranks share: forces by hand, the run of one rank, checkpoints.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/shared_runs.hpp"

namespace ashlar::shared_bolts_test {
namespace {

using test_support::advance;
using test_support::block_of;
using test_support::distance;
using test_support::end_of;
using test_support::fixed_box;
using test_support::looking_each;
using test_support::run_alone;
using test_support::run_shared;
using test_support::run_static;
using test_support::Scene;
using test_support::spring_joint;
using test_support::stored_snapshot;

constexpr double gravity = 9.81;
const Material rock{2500.0, 1e10, 0.2};

BoltLaw elastic(double axial_stiffness) {
  BoltLaw law;
  law.axial_stiffness = axial_stiffness;
  law.anchorage = BoltAnchorage::ends;
  return law;
}

/// A bar between two points that is held at its ends.
Bolt bar(int block_a, const Vector3& from, int block_b, const Vector3& to, const BoltLaw& law) {
  const double length = (to - from).norm();
  const std::vector<BoltSpan> spans = {{block_a, 1, 0.0, 0.0}, {block_b, 1, length, length}};
  return {"bar", BoltChain(law, BoltShape(law, from, to, spans, 0.02), {true, true}), true};
}

/// A scene with bolts.
struct Bolted : Scene {
  std::vector<Bolt> bolts;

  void add(Bolt bolt) {
    bolts.push_back(std::move(bolt));
    start = [all = bolts](Simulation& simulation) { simulation.add_bolts(all); };
  }
};

/// The end of a run with its bolts.
struct BoltedEnd {
  test_support::End run;
  std::vector<BoltState> bolts;
};

BoltedEnd end_with_bolts(Simulation& simulation) {
  test_support::End run = end_of(simulation);
  simulation.gather_results();
  return {std::move(run), simulation.bolts()};
}

BoltedEnd advance_bolted(Simulation& simulation, int steps) {
  EXPECT_TRUE(advance(simulation, steps));
  return end_with_bolts(simulation);
}

auto bolted_to(int steps) {
  return [steps](Simulation& simulation) { return advance_bolted(simulation, steps); };
}

/// Blocks of 1 m^3 in a row below a fixed roof, 1 m from each other and out of contact, each hung on the one above by
/// four bars.
Bolted hanging(int count, const BoltLaw& law) {
  Bolted bolted;
  bolted.law = spring_joint(0.5);
  bolted.settings.time_step = 1e-3;
  bolted.settings.gravity = {0, 0, -gravity};
  bolted.blocks.push_back(fixed_box({-1, -1, 0}, {2, 2, 1}));
  for (int k = 0; k < count; ++k) {
    const double top = -1.0 - 2.0 * k;
    bolted.blocks.push_back(block_of("block", Polyhedron(make_box({0, 0, top - 1.0}, {1, 1, top})), rock, 1));
    for (const auto& [x, y] : {std::pair(0.1, 0.1), {0.9, 0.1}, {0.1, 0.9}, {0.9, 0.9}})
      bolted.add(bar(k, {x, y, top + 1.0}, k + 1, {x, y, top}, law));
  }
  bolted.motions.resize(bolted.blocks.size());
  return bolted;
}

/// Two columns of blocks on a fixed base under inclined gravity, each with a grouted bolt through all of it, and a prop
/// between their tops, of which one moves towards the other. The grout slips, and the joints slide.
Bolted pinned_columns(int blocks) {
  Bolted bolted;
  bolted.law = spring_joint(0.2);
  bolted.settings.time_step = 1e-3;
  bolted.settings.contact_distance = 2e-3;
  bolted.settings.gravity = {3.0, 0.5, -gravity};
  bolted.blocks.push_back(fixed_box({-1, -1, -2}, {5, 2, 0}));
  BoltLaw law = elastic(1e8);
  law.anchorage = BoltAnchorage::grouted;
  law.bond_stiffness = 1e9;
  law.bond_strength = 2e4;
  law.shear_stiffness = 1e7;
  law.shear_strength = 2e3;
  for (int column = 0; column < 2; ++column) {
    const double x = 3.0 * column;
    std::vector<BoltSpan> spans;
    for (int k = 0; k < blocks; ++k) {
      bolted.blocks.push_back(block_of("block", Polyhedron(make_box({x, 0, 1.0 * k}, {x + 1.0, 1, k + 1.0})),
                                       rock, k == 1 ? 2 : 1));
      const int block = static_cast<int>(bolted.blocks.size()) - 1;
      spans.insert(spans.begin(), {block, 2, 1.0 * (blocks - 1 - k), 1.0 * (blocks - k)});
    }
    spans.push_back({0, 1, 1.0 * blocks, blocks + 1.0});
    bolted.add(
        {"grouted",
         BoltChain(law, BoltShape(law, {x + 0.4, 0.5, 1.0 * blocks}, {x + 0.4, 0.5, -1.0}, spans, 0.03),
                   std::vector<bool>(spans.size(), true)),
         true});
  }
  const double top = blocks - 0.5;
  bolted.add(bar(blocks, {1, 0.5, top}, 2 * blocks, {3, 0.5, top}, elastic(1e7)));
  bolted.motions.resize(bolted.blocks.size());
  bolted.motions[at(blocks)].velocity = {0.1, 0.0, 0.0};
  return bolted;
}

/// All blocks of other ranks than their neighbours.
std::vector<int> in_turn(std::size_t blocks, int ranks) {
  std::vector<int> owners;
  for (std::size_t k = 0; k < blocks; ++k) owners.push_back(static_cast<int>((k + 1) % at(ranks)));
  return owners;
}

void expect_same(const BoltedEnd& one, const BoltedEnd& other, double tolerance) {
  EXPECT_LE(distance(one.run, other.run), tolerance);
  ASSERT_EQ(one.bolts.size(), other.bolts.size());
  for (std::size_t k = 0; k < one.bolts.size(); ++k) {
    const double force = std::abs(largest_axial_force(one.bolts[k]));
    EXPECT_NEAR(largest_axial_force(one.bolts[k]), largest_axial_force(other.bolts[k]), 1e-6 * force) << k;
    EXPECT_NEAR(largest_shear_force(one.bolts[k]), largest_shear_force(other.bolts[k]), 1e-6 * force) << k;
    EXPECT_EQ(one.bolts[k].reached.sheared, other.bolts[k].reached.sheared) << k;
  }
  const Ledger& a = one.run.totals.ledger;
  const Ledger& b = other.run.totals.ledger;
  const double energy = a.kinetic + a.contact + a.friction;
  EXPECT_NEAR(a.contact, b.contact, 1e-7 * energy);
  EXPECT_NEAR(a.friction, b.friction, 1e-7 * energy);
  EXPECT_NEAR(a.applied, b.applied, 1e-7 * energy);
  EXPECT_NEAR(a.balance(), b.balance(), 1e-7 * energy);
}

TEST(SharedBolts, BarsOfBlocksOfOtherRanksCarryTheWeightBelow) {
  const Bolted bolted = hanging(2, elastic(1e7));
  const double share = 2500.0 * gravity / 4.0;
  for (const std::vector<int>& owners : {std::vector<int>{0, 1, 2}, {2, 0, 1}, {1, 1, 0}}) {
    const BoltedEnd end = run_shared(bolted, owners, 3, [](Simulation& simulation) {
      EXPECT_TRUE(simulation.loose_blocks().empty());
      EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
      return end_with_bolts(simulation);
    });
    ASSERT_EQ(end.bolts.size(), 8U);
    for (std::size_t k = 0; k < 8; ++k) {
      const double expected = k < 4 ? 2.0 * share : share;
      EXPECT_NEAR(end.bolts[k].axial[0], expected, 1e-4 * expected) << k;
    }
    // 1/2 F^2 L / EA of each bar, each once.
    const double stored = 4.0 * 0.5 * (4.0 + 1.0) * share * share / 1e7;
    EXPECT_NEAR(end.run.totals.ledger.contact, stored, 1e-3 * stored);
  }
}

TEST(SharedBolts, AMotionIsThatOfOneRank) {
  const Bolted bolted = pinned_columns(3);
  const BoltedEnd one = run_alone(bolted, bolted_to(60));
  EXPECT_NE(condition_of(bolted.bolts[0], one.bolts[0]), BoltCondition::elastic);
  for (const int ranks : {2, 3})
    expect_same(one, run_shared(bolted, in_turn(bolted.blocks.size(), ranks), ranks, bolted_to(60)), 1e-9);
}

TEST(SharedBolts, ABarRupturesOnceForAllRanks) {
  BoltLaw law = elastic(1e7);
  law.yield_force = 0.3 * 2500.0 * gravity;
  law.rupture_strain = 0.02;
  const Bolted bolted = hanging(2, law);
  const BoltedEnd one = run_alone(bolted, bolted_to(150));
  const BoltedEnd end = run_shared(bolted, {0, 1, 2}, 3, bolted_to(150));
  EXPECT_EQ(condition_of(bolted.bolts[0], end.bolts[0]), BoltCondition::ruptured);
  expect_same(one, end, 1e-9);
  // In statics it cannot stand either.
  (void)run_shared(bolted, {0, 1, 2}, 3, [](Simulation& simulation) {
    EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  });
}

TEST(SharedBolts, ACheckpointGoesOnWithAnyNumberOfRanks) {
  const Bolted bolted = pinned_columns(3);
  const BoltedEnd one = run_alone(bolted, bolted_to(40));
  const std::size_t blocks = bolted.blocks.size();
  const std::string stored = run_shared(bolted, in_turn(blocks, 3), 3, [](Simulation& simulation) {
    EXPECT_TRUE(advance(simulation, 20));
    return stored_snapshot(simulation);
  });
  const auto go_on = [&](Simulation& simulation) {
    simulation.restore(snapshot_from_bytes(stored));
    return advance_bolted(simulation, 40);
  };
  expect_same(one, run_alone(bolted, go_on), 1e-9);
  expect_same(one, run_shared(bolted, in_turn(blocks, 2), 2, go_on), 1e-9);
}

TEST(SharedBolts, GoWithTheirBlocksToOtherRanks) {
  const Bolted bolted = pinned_columns(3);
  // All blocks but one belong to the first rank. Columns are asked for later.
  const std::vector<int> columns = {0, 0, 0, 0, 1, 1, 1};
  const auto partition = [&](Ranks&, const std::vector<PartitionBlock>& own, int) {
    // A bolt joins blocks that do not touch.
    for (const PartitionBlock& block : own) {
      const std::vector<int>& others = block.neighbours;
      EXPECT_TRUE(block.block != 3 || std::find(others.begin(), others.end(), 6) != others.end());
    }
    return columns;
  };
  const BoltedEnd end =
      run_shared(bolted, {0, 0, 0, 0, 0, 0, 1}, 2, bolted_to(40), looking_each(20, partition));
  EXPECT_EQ(end.run.work[0].repartitions, 1);
  expect_same(run_alone(bolted, bolted_to(40)), end, 1e-9);
}

TEST(SharedBolts, BoltedBlocksOfTwoRanksSleepTogether) {
  Bolted bolted = hanging(2, elastic(1e7));
  bolted.settings.contact_distance = 2e-3;
  bolted.settings.mass_damping = 20.0;
  const BoltedEnd end = run_shared(bolted, {0, 1, 0}, 2, bolted_to(1500));
  EXPECT_EQ(end.run.totals.counts.islands_put_to_sleep, 1U);
  const BoltedEnd one = run_alone(bolted, bolted_to(1500));
  EXPECT_EQ(one.run.totals.counts.sleeping_block_steps, end.run.totals.counts.sleeping_block_steps);
  EXPECT_NEAR(one.run.totals.ledger.contact, end.run.totals.ledger.contact,
              1e-9 * one.run.totals.ledger.contact);
}

TEST(SharedBolts, MotionFromEquilibriumStaysAtRest) {
  const BoltedEnd end = run_shared(hanging(2, elastic(1e7)), {0, 1, 0}, 2, [](Simulation& simulation) {
    EXPECT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
    return advance_bolted(simulation, 50);
  });
  const double share = 2500.0 * gravity / 4.0;
  EXPECT_NEAR(end.bolts[0].axial[0], 2.0 * share, 2e-4 * share);
  EXPECT_NEAR(end.bolts[7].axial[0], share, 1e-4 * share);
  EXPECT_LE(std::abs(end.run.totals.ledger.residual), 1e-8);
}

}  // namespace
}  // namespace ashlar::shared_bolts_test

// Bolts and props between blocks that several ranks share: forces by hand, the run of one rank, checkpoints.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/run/checkpoint.hpp"
#include "solver/step/rank_balance.hpp"
#include "support/shared_runs.hpp"

namespace ashlar::shared_bolts_test {
namespace {

using test_support::advance;
using test_support::block_of;
using test_support::end_of;
using test_support::fixed_box;
using test_support::joint;
using test_support::run_static;
using test_support::same_law;
using test_support::Scene;

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

struct Bolted {
  Scene scene;
  std::vector<Bolt> bolts;

  [[nodiscard]] Simulation alone() const {
    std::vector<BlockModel> blocks;
    for (const BlockDefinition& block : scene.blocks) blocks.emplace_back(block);
    Simulation simulation(std::move(blocks), scene.motions, same_law(scene.law), scene.settings);
    simulation.add_bolts(bolts);
    return simulation;
  }
  [[nodiscard]] Simulation shared(Ranks& ranks, const std::vector<int>& owners,
                                  const Rebalancing& balance = {}) const {
    const auto load = [this](int block) { return BlockModel(scene.blocks[at(block)]); };
    BlocksOfRank blocks = share_blocks(ranks, owners, load, scene.settings, {}, nullptr, ranks.own() == 0);
    blocks.shared->balance = balance;
    Simulation simulation(std::move(blocks), scene.motions, same_law(scene.law), scene.settings);
    simulation.add_bolts(bolts);
    return simulation;
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

/// @param run called on each rank. @return end of the first one
template <class Run>
BoltedEnd on_ranks(const Bolted& bolted, const std::vector<int>& owners, int ranks, const Run& run,
                   const Rebalancing& balance = {}) {
  BoltedEnd end;
  run_on_threads(ranks, [&](Ranks& own) {
    Simulation simulation = bolted.shared(own, owners, balance);
    run(simulation);
    BoltedEnd here = end_with_bolts(simulation);
    if (own.own() == 0) end = std::move(here);
  });
  return end;
}

/// Blocks of 1 m^3 in a row below a fixed roof, 1 m from each other and out of contact, each hung on the one above by
/// four bars.
Bolted hanging(int count, const BoltLaw& law) {
  Bolted bolted;
  Scene& scene = bolted.scene;
  scene.law = joint(0.5);
  scene.settings.time_step = 1e-3;
  scene.settings.gravity = {0, 0, -gravity};
  scene.blocks.push_back(fixed_box({-1, -1, 0}, {2, 2, 1}));
  for (int k = 0; k < count; ++k) {
    const double top = -1.0 - 2.0 * k;
    scene.blocks.push_back(block_of("block", Polyhedron(make_box({0, 0, top - 1.0}, {1, 1, top})), rock, 1));
    for (const auto& [x, y] : {std::pair(0.1, 0.1), {0.9, 0.1}, {0.1, 0.9}, {0.9, 0.9}})
      bolted.bolts.push_back(bar(k, {x, y, top + 1.0}, k + 1, {x, y, top}, law));
  }
  scene.motions.resize(scene.blocks.size());
  return bolted;
}

/// Two columns of blocks on a fixed base under inclined gravity, each with a grouted bolt through all of it, and a prop
/// between their tops, of which one moves towards the other. The grout slips, and the joints slide.
Bolted pinned_columns(int blocks) {
  Bolted bolted;
  Scene& scene = bolted.scene;
  scene.law = joint(0.2);
  scene.settings.time_step = 1e-3;
  scene.settings.contact_distance = 2e-3;
  scene.settings.gravity = {3.0, 0.5, -gravity};
  scene.blocks.push_back(fixed_box({-1, -1, -2}, {5, 2, 0}));
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
      scene.blocks.push_back(block_of("block", Polyhedron(make_box({x, 0, 1.0 * k}, {x + 1.0, 1, k + 1.0})),
                                      rock, k == 1 ? 2 : 1));
      const int block = static_cast<int>(scene.blocks.size()) - 1;
      spans.insert(spans.begin(), {block, 2, 1.0 * (blocks - 1 - k), 1.0 * (blocks - k)});
    }
    spans.push_back({0, 1, 1.0 * blocks, blocks + 1.0});
    bolted.bolts.push_back(
        {"grouted",
         BoltChain(law, BoltShape(law, {x + 0.4, 0.5, 1.0 * blocks}, {x + 0.4, 0.5, -1.0}, spans, 0.03),
                   std::vector<bool>(spans.size(), true)),
         true});
  }
  const double top = blocks - 0.5;
  bolted.bolts.push_back(bar(blocks, {1, 0.5, top}, 2 * blocks, {3, 0.5, top}, elastic(1e7)));
  scene.motions.resize(scene.blocks.size());
  scene.motions[at(blocks)].velocity = {0.1, 0.0, 0.0};
  return bolted;
}

/// All blocks of other ranks than their neighbours.
std::vector<int> in_turn(std::size_t blocks, int ranks) {
  std::vector<int> owners;
  for (std::size_t k = 0; k < blocks; ++k) owners.push_back(static_cast<int>((k + 1) % at(ranks)));
  return owners;
}

void expect_same(const BoltedEnd& one, const BoltedEnd& other, double tolerance) {
  EXPECT_LE(test_support::distance(one.run, other.run), tolerance);
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
    StaticStatus status = StaticStatus::balancing;
    const BoltedEnd end = on_ranks(bolted, owners, 3, [&](Simulation& simulation) {
      EXPECT_TRUE(simulation.loose_blocks().empty());
      const StaticStatus here = run_static(simulation, 1.0);
      if (simulation.system().share()->ranks().own() == 0) status = here;
    });
    EXPECT_EQ(status, StaticStatus::equilibrium);
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
  Simulation alone = bolted.alone();
  ASSERT_TRUE(advance(alone, 60));
  const BoltedEnd one = end_with_bolts(alone);
  EXPECT_NE(condition_of(bolted.bolts[0], one.bolts[0]), BoltCondition::elastic);
  for (const int ranks : {2, 3}) {
    const BoltedEnd end = on_ranks(bolted, in_turn(bolted.scene.blocks.size(), ranks), ranks,
                                   [](Simulation& simulation) { EXPECT_TRUE(advance(simulation, 60)); });
    expect_same(one, end, 1e-9);
  }
}

TEST(SharedBolts, ABarRupturesOnceForAllRanks) {
  BoltLaw law = elastic(1e7);
  law.yield_force = 0.3 * 2500.0 * gravity;
  law.rupture_strain = 0.02;
  const Bolted bolted = hanging(2, law);
  Simulation alone = bolted.alone();
  ASSERT_TRUE(advance(alone, 150));
  const BoltedEnd one = end_with_bolts(alone);
  const BoltedEnd end =
      on_ranks(bolted, {0, 1, 2}, 3, [](Simulation& simulation) { EXPECT_TRUE(advance(simulation, 150)); });
  EXPECT_EQ(condition_of(bolted.bolts[0], end.bolts[0]), BoltCondition::ruptured);
  expect_same(one, end, 1e-9);
  // In statics it cannot stand either.
  (void)on_ranks(bolted, {0, 1, 2}, 3, [](Simulation& simulation) {
    EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  });
}

TEST(SharedBolts, ACheckpointGoesOnWithAnyNumberOfRanks) {
  const Bolted bolted = pinned_columns(3);
  Simulation alone = bolted.alone();
  ASSERT_TRUE(advance(alone, 40));
  const BoltedEnd one = end_with_bolts(alone);
  std::string stored;
  const std::size_t blocks = bolted.scene.blocks.size();
  (void)on_ranks(bolted, in_turn(blocks, 3), 3, [&](Simulation& simulation) {
    EXPECT_TRUE(advance(simulation, 20));
    simulation.gather_results();
    const SimulationSnapshot snapshot = simulation.snapshot();
    if (simulation.system().share()->ranks().own() == 0) stored = to_bytes(snapshot);
  });
  const auto go_on = [&](Simulation& simulation) {
    simulation.restore(snapshot_from_bytes(stored));
    EXPECT_TRUE(advance(simulation, 40));
  };
  Simulation resumed = bolted.alone();
  go_on(resumed);
  expect_same(one, end_with_bolts(resumed), 1e-9);
  expect_same(one, on_ranks(bolted, in_turn(blocks, 2), 2, go_on), 1e-9);
}

TEST(SharedBolts, GoWithTheirBlocksToOtherRanks) {
  const Bolted bolted = pinned_columns(3);
  Simulation alone = bolted.alone();
  ASSERT_TRUE(advance(alone, 40));
  const BoltedEnd one = end_with_bolts(alone);
  // All blocks but one belong to the first rank. Columns are asked for later.
  const std::vector<int> columns = {0, 0, 0, 0, 1, 1, 1};
  Rebalancing balance;
  balance.interval = 20;
  balance.partition = [&](Ranks&, const std::vector<PartitionBlock>& own, int) {
    // A bolt joins blocks that do not touch.
    for (const PartitionBlock& block : own) {
      const std::vector<int>& others = block.neighbours;
      EXPECT_TRUE(block.block != 3 || std::find(others.begin(), others.end(), 6) != others.end());
    }
    return columns;
  };
  const BoltedEnd end = on_ranks(
      bolted, {0, 0, 0, 0, 0, 0, 1}, 2, [](Simulation& simulation) { EXPECT_TRUE(advance(simulation, 40)); },
      balance);
  EXPECT_EQ(end.run.work[0].repartitions, 1);
  expect_same(one, end, 1e-9);
}

TEST(SharedBolts, BoltedBlocksOfTwoRanksSleepTogether) {
  Bolted bolted = hanging(2, elastic(1e7));
  bolted.scene.settings.contact_distance = 2e-3;
  bolted.scene.settings.mass_damping = 20.0;
  const auto rest = [](Simulation& simulation) { EXPECT_TRUE(advance(simulation, 1500)); };
  const BoltedEnd end = on_ranks(bolted, {0, 1, 0}, 2, rest);
  EXPECT_EQ(end.run.totals.counts.islands_put_to_sleep, 1U);
  Simulation alone = bolted.alone();
  rest(alone);
  const BoltedEnd one = end_with_bolts(alone);
  EXPECT_EQ(one.run.totals.counts.sleeping_block_steps, end.run.totals.counts.sleeping_block_steps);
  EXPECT_NEAR(one.run.totals.ledger.contact, end.run.totals.ledger.contact,
              1e-9 * one.run.totals.ledger.contact);
}

TEST(SharedBolts, MotionFromEquilibriumStaysAtRest) {
  const Bolted bolted = hanging(2, elastic(1e7));
  const BoltedEnd end = on_ranks(bolted, {0, 1, 0}, 2, [](Simulation& simulation) {
    EXPECT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
    EXPECT_TRUE(advance(simulation, 50));
  });
  const double share = 2500.0 * gravity / 4.0;
  EXPECT_NEAR(end.bolts[0].axial[0], 2.0 * share, 2e-4 * share);
  EXPECT_NEAR(end.bolts[7].axial[0], share, 1e-4 * share);
  EXPECT_LE(std::abs(end.run.totals.ledger.residual), 1e-8);
}

}  // namespace
}  // namespace ashlar::shared_bolts_test

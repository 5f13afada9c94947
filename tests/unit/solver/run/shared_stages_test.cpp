// Stages of simulations whose blocks several ranks share: each stage has owners of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

#include "geometry/index.hpp"
#include "solver/ranks/thread_ranks.hpp"
#include "solver/run/checkpoint.hpp"
#include "solver/shared/gathered_run.hpp"
#include "support/shared_runs.hpp"
#include "support/simulations.hpp"

namespace ashlar::shared_stages_test {
namespace {

using test_support::advance;
using test_support::block_of;
using test_support::End;
using test_support::end_of;
using test_support::fixed_box;
using test_support::on_first_of;
using test_support::owners_along;
using test_support::run_static;
using test_support::Scene;

struct Stage {
  std::vector<int> absent = {};  ///< blocks
  int last = 0;                  ///< step of the run at its end
  bool statics = false;
  int axis = 0;  ///< by which blocks are shared out
};

Scene in_stage(Scene scene, const Stage& stage) {
  scene.absent.assign(scene.blocks.size(), false);
  for (const int block : stage.absent) scene.absent[at(block)] = true;
  return scene;
}

Simulation alone(const Scene& scene, const Stage& stage) {
  return test_support::simulation_alone(in_stage(scene, stage));
}

Simulation shared(const Scene& scene, const Stage& stage, Ranks& ranks) {
  return test_support::simulation_on(ranks, in_stage(scene, stage),
                                     owners_along(stage.axis, scene.blocks, ranks.count()), {},
                                     test_support::FirstRank::has_its_own);
}

void run_stage(const Stage& stage, Simulation& simulation) {
  if (stage.statics)
    EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  else
    EXPECT_TRUE(advance(simulation, stage.last));
}

/// The last of some stages, at its end. @param make (stage)
template <class Make>
Simulation run_stages(const std::vector<Stage>& stages, const Make& make) {
  Simulation now = make(stages.front());
  run_stage(stages.front(), now);
  for (std::size_t k = 1; k < stages.size(); ++k) {
    now.gather_results({false, {}, {}});
    Simulation next = make(stages[k]);
    next.start_stage(now);
    now = std::move(next);
    run_stage(stages[k], now);
  }
  return now;
}

End stages_alone(const Scene& scene, const std::vector<Stage>& stages) {
  return end_of(run_stages(stages, [&](const Stage& stage) { return alone(scene, stage); }));
}

End stages_shared(const Scene& scene, const std::vector<Stage>& stages, int ranks) {
  return on_first_of(ranks, [&](Ranks& own) {
    return end_of(run_stages(stages, [&](const Stage& stage) { return shared(scene, stage, own); }));
  });
}

/// Middle of a block of order 0 or more at the end, m.
Vector3 middle_of(const Scene& scene, const End& end, int block) {
  const BlockModel model(scene.blocks[at(block)]);
  return end.states[at(block)].position.transpose() * model.basis().values(model.basis().centroid());
}

/// A wall that stands loses two bricks of its lowest course, and then one of the second.
const std::vector<Stage> undermining = {
    {{}, 30, false, 0}, {{2, 3}, 80, false, 2}, {{2, 3, 8}, 110, false, 0}};

TEST(SharedStages, BricksFallAlikeWhereOthersAreRemoved) {
  const Scene scene = test_support::wall(5, 5);
  const End expected = stages_alone(scene, undermining);
  EXPECT_LT(middle_of(scene, expected, 7).z(), 0.3 - 0.05);  // of the second course
  for (const int ranks : {1, 2, 4}) {
    const End end = stages_shared(scene, undermining, ranks);
    EXPECT_EQ(end.steps, 110);
    EXPECT_LE(test_support::distance(end, expected), 1e-8) << ranks;
    const double energy = expected.totals.ledger.kinetic;
    EXPECT_GT(energy, 1.0);
    EXPECT_NEAR(end.totals.ledger.kinetic, energy, 1e-6 * energy) << ranks;
    EXPECT_NEAR(end.totals.ledger.residual, expected.totals.ledger.residual, 1e-6 * energy) << ranks;
  }
}

TEST(SharedStages, CountsOfWorkContinue) {
  const Scene scene = test_support::wall(3, 4);
  const std::vector<Stage> stages = {{{}, 20, false, 0}, {{3}, 40, false, 2}};
  const End expected = stages_alone(scene, stages);
  const End end = stages_shared(scene, stages, 2);
  EXPECT_EQ(end.totals.counts.contact_points, expected.totals.counts.contact_points);
  const End first = stages_shared(scene, {stages.front()}, 2);
  for (const std::size_t rank : {0U, 1U}) {
    EXPECT_GT(first.work[rank].points, 0);
    EXPECT_GT(end.work[rank].points, first.work[rank].points);
    EXPECT_GE(end.work[rank].shared.solves, first.work[rank].shared.solves + 20);
    EXPECT_GT(end.work[rank].for_results.bytes, first.work[rank].for_results.bytes);
  }
}

TEST(SharedStages, AWallInEquilibriumStaysAtRest) {
  const Scene scene = test_support::wall(2, 2);
  const std::vector<Stage> stages = {{{}, 0, true, 0}, {{}, 0, false, 2}};
  const End still = stages_alone(scene, stages);
  for (const int ranks : {2, 3}) {
    std::vector<Stage> longer = stages;
    longer.back().last = still.steps + 20;
    const End end = stages_shared(scene, longer, ranks);
    EXPECT_EQ(end.steps, longer.back().last);
    // 0.04 s of free fall are 8 mm.
    EXPECT_LE(test_support::distance(end, still), 1e-7) << ranks;
  }
}

TEST(SharedStages, AnAddedBlockFallsFreely) {
  Scene scene = test_support::wall(2, 3);
  scene.blocks.push_back(
      block_of("late", Polyhedron(make_box({0.5, 0, 2}, {0.7, 0.2, 2.2})), {2000, 1e9, 0.2}, 1));
  scene.motions.emplace_back();
  const int late = static_cast<int>(scene.blocks.size()) - 1;
  const double time = 50 * scene.settings.time_step;
  for (const int ranks : {2, 3}) {
    const End end = stages_shared(scene, {{{late}, 30, false, 2}, {{}, 80, false, 0}}, ranks);
    EXPECT_NEAR(middle_of(scene, end, late).z(), 2.1 - 0.5 * 9.81 * time * time, 1e-9) << ranks;
  }
}

TEST(SharedStages, ABlockTiedToOneThatHasMovedIsRefusedAlike) {
  Scene scene;
  scene.law = test_support::spring_joint(0.5);
  scene.settings.time_step = 2e-3;
  scene.settings.contact_distance = 2e-3;
  scene.blocks = {fixed_box({-1, -1, -9}, {3, 2, -8}),
                  block_of("falling", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2000, 1e9, 0.2}, 1),
                  block_of("late", Polyhedron(make_box({1, 0, 0}, {2, 1, 1})), {2000, 1e9, 0.2}, 1)};
  scene.motions.resize(3);
  scene.ties = {{1, 2, 1e10}};
  const std::vector<Stage> stages = {{{2}, 50, false, 0}, {{}, 60, false, 0}};
  const auto fault_of = [](const auto& run) {
    try {
      run();
      return std::string("none");
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
  };
  const std::string expected = fault_of([&] { return stages_alone(scene, stages); });
  EXPECT_NE(expected.find("block late is added with a tie to block falling"), std::string::npos) << expected;
  for (const int ranks : {2, 3}) {
    std::vector<std::string> faults(at(ranks));
    run_on_threads(ranks, [&](Ranks& own) {
      faults[at(own.own())] = fault_of([&] {
        return run_stages(stages, [&](const Stage& stage) { return shared(scene, stage, own); }).steps();
      });
    });
    for (const std::string& fault : faults) EXPECT_EQ(fault, expected);
  }
}

/// Two cubes of 1 m fly apart, so that their joint fails: far from each other no rank has both.
TEST(SharedStages, FailedJointsFarApartAreCounted) {
  Scene scene;
  scene.law = test_support::spring_joint(0.5);
  scene.law.tensile_strength = 1e3;
  scene.law.cohesion = 1e3;
  scene.settings.gravity.setZero();
  scene.settings.time_step = 1e-2;
  scene.settings.contact_distance = 2e-3;
  for (const double x : {0.0, 1.0})
    scene.blocks.push_back(
        block_of("cube", Polyhedron(make_box({x, 0, 0}, {x + 1, 1, 1})), {2000, 1e9, 0.2}, 1));
  scene.motions.resize(2);
  scene.motions[0].velocity.x() = -2.0;
  scene.motions[1].velocity.x() = 2.0;
  const std::vector<Stage> stages = {{{}, 100, false, 0}, {{}, 120, false, 0}};
  for (const int ranks : {1, 2}) {
    const End end = stages_shared(scene, stages, ranks);
    const auto sum = [&](double RankWork::*area) {
      return std::accumulate(end.work.begin(), end.work.end(), 0.0,
                             [area](double all, const RankWork& work) { return all + work.*area; });
    };
    EXPECT_NEAR(sum(&RankWork::bonded_area), 1.0, 1e-12) << ranks;
    EXPECT_NEAR(sum(&RankWork::broken_area), 1.0, 1e-12) << ranks;
  }
}

/// Of three cubes on brittle joints the last one slides, which belongs to another rank than results.
TEST(SharedStages, PointsThatHaveFailedOnAnyRankAreTold) {
  Scene scene;
  scene.law = test_support::spring_joint(0.5);
  scene.law.cohesion = 1e4;
  scene.settings.time_step = 1e-3;
  scene.settings.contact_distance = 2e-3;
  scene.blocks.push_back(fixed_box({-1, -1, -1}, {9, 2, 0}));
  for (const double x : {0.0, 2.0, 4.0})
    scene.blocks.push_back(
        block_of("cube", Polyhedron(make_box({x, 0, 0}, {x + 1, 1, 1})), {2000, 1e9, 0.2}, 1));
  scene.motions.resize(scene.blocks.size());
  scene.motions[3].velocity.x() = 1.0;
  for (const int ranks : {1, 2, 3}) {
    const auto failed = test_support::run_shared(
        scene, owners_along(0, scene.blocks, ranks), ranks, [](Simulation& simulation) {
          EXPECT_TRUE(advance(simulation, 40));
          simulation.gather_results();
          std::vector<double> share;  // of the points of each pair
          for (const PairRecord& record : simulation.contacts()) {
            const std::vector<char> lost = simulation.points_without_strength(record);
            share.push_back(static_cast<double>(std::count(lost.begin(), lost.end(), 1)) /
                            static_cast<double>(record.points.size()));
          }
          return share;
        });
    EXPECT_EQ(failed, (std::vector<double>{0.0, 0.0, 1.0})) << ranks;
  }
}

TEST(SharedStages, AStageGoesOnFromItsCheckpointOnOtherRanks) {
  const Scene scene = test_support::wall(5, 5);
  const End expected = stages_alone(scene, undermining);
  std::vector<Stage> half = {undermining[0], undermining[1]};
  half.back().last = 55;
  const SimulationSnapshot saved = on_first_of(2, [&](Ranks& own) {
    Simulation simulation = run_stages(half, [&](const Stage& stage) { return shared(scene, stage, own); });
    simulation.gather_results({false, {}, {}});
    return simulation.snapshot();
  });
  const End end = on_first_of(3, [&](Ranks& own) {
    Simulation now = shared(scene, undermining[1], own);
    now.restore(saved);
    run_stage(undermining[1], now);
    now.gather_results({false, {}, {}});
    Simulation last = shared(scene, undermining[2], own);
    last.start_stage(now);
    run_stage(undermining[2], last);
    return end_of(last);
  });
  EXPECT_LE(test_support::distance(end, expected), 1e-8);
}

}  // namespace
}  // namespace ashlar::shared_stages_test

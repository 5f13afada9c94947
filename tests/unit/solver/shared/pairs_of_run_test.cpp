#include "solver/shared/pairs_of_run.hpp"

#include <gmock/gmock.h>

#include <mutex>
#include <set>
#include <stdexcept>

#include "solver/ranks/rank_messages.hpp"
#include "support/shared_runs.hpp"

namespace ashlar::pairs_of_run_test {
namespace {

using test_support::advance;
using test_support::owners_of;
using test_support::Scene;
using test_support::wall;

/// 14 courses: more pairs than one message has.
Scene tall_wall() {
  return wall(14, 15);
}

/// Calls use(simulation, rank) on each of some ranks, after a step; with 0 once, without ranks.
void step_on(int count, const Scene& scene, const std::function<void(Simulation&, int)>& use) {
  if (count == 0) {
    Simulation simulation = test_support::simulation_alone(scene);
    ASSERT_TRUE(advance(simulation, 1));
    return use(simulation, 0);
  }
  run_on_threads(count, [&](Ranks& own) {
    Simulation simulation = test_support::simulation_on(own, scene, owners_of(scene, count));
    ASSERT_TRUE(advance(simulation, 1));
    use(simulation, own.own());
  });
}

/// Pairs as a rank visits them.
struct Visited {
  std::size_t histories = 0, records = 0;  ///< as announced
  std::vector<PairKey> pairs, recorded;
  std::vector<std::size_t> points;  ///< remembered points of each pair
  std::vector<double> forces;       ///< N, of each record
};

Visited visit(Simulation& simulation, PairVisitors visitors = PairVisitors::first) {
  Visited visited;
  PairsOfRun pairs = simulation.pairs_of_run(visitors);
  pairs.visit_histories([&](std::size_t count) { visited.histories = count; },
                        [&](const PairKey& blocks, const PairHistory& history) {
                          visited.pairs.push_back(blocks);
                          visited.points.push_back(history.memory.entries().size());
                        });
  pairs.visit_records([&](std::size_t count) { visited.records = count; },
                      [&](const PairRecord& record) {
                        visited.recorded.push_back({record.a, record.b});
                        visited.forces.push_back(force_on_a(record).norm());
                      });
  return visited;
}

TEST(PairsOfRun, TheFirstRankVisitsThePairsOfAllRanksInOrder) {
  const Scene scene = tall_wall();
  Visited alone;
  step_on(0, scene, [&](Simulation& simulation, int) { alone = visit(simulation); });
  EXPECT_EQ(alone.histories, alone.pairs.size());
  // 7 courses of 15 bricks and 7 of 14: 15 on the ground, 28 pairs of each two courses, 189 side by side.
  ASSERT_EQ(alone.records, 568u);
  for (const int count : {1, 2, 3}) {
    step_on(count, scene, [&](Simulation& simulation, int rank) {
      const Visited visited = visit(simulation);
      if (rank > 0) {
        EXPECT_TRUE(visited.pairs.empty() && visited.recorded.empty());
        return;
      }
      EXPECT_EQ(visited.histories, visited.pairs.size());
      EXPECT_EQ(visited.records, visited.recorded.size());
      EXPECT_EQ(visited.recorded, alone.recorded);
      EXPECT_TRUE(std::is_sorted(visited.pairs.begin(), visited.pairs.end()));
      EXPECT_EQ(std::set(visited.pairs.begin(), visited.pairs.end()).size(), visited.pairs.size());
      // Pairs that have not touched may be known to one rank and not to another one.
      const std::map<PairKey, std::size_t> expected = [&] {
        std::map<PairKey, std::size_t> points;
        for (std::size_t k = 0; k < alone.pairs.size(); ++k)
          if (alone.points[k] > 0) points.emplace(alone.pairs[k], alone.points[k]);
        return points;
      }();
      std::map<PairKey, std::size_t> found;
      for (std::size_t k = 0; k < visited.pairs.size(); ++k)
        if (visited.points[k] > 0) found.emplace(visited.pairs[k], visited.points[k]);
      EXPECT_EQ(found, expected);
      double largest = 0.0;
      for (std::size_t k = 0; k < alone.forces.size(); ++k)
        largest = std::max(largest, std::abs(visited.forces[k] - alone.forces[k]));
      // A brick weighs 313.9 N.
      EXPECT_LT(largest, 1e-6 * 313.9);
    });
  }
}

TEST(PairsOfRun, AllRanksVisitTheSamePairs) {
  const Scene scene = tall_wall();
  std::mutex mutex;
  std::vector<Visited> of_ranks;
  step_on(3, scene, [&](Simulation& simulation, int) {
    Visited visited = visit(simulation, PairVisitors::all);
    const std::lock_guard lock(mutex);
    of_ranks.push_back(std::move(visited));
  });
  ASSERT_EQ(of_ranks.size(), 3u);
  EXPECT_EQ(of_ranks[0].records, of_ranks[0].recorded.size());
  EXPECT_EQ(of_ranks[0].records, 568u);
  for (const Visited& visited : of_ranks) {
    EXPECT_EQ(visited.histories, of_ranks[0].histories);
    EXPECT_EQ(visited.pairs, of_ranks[0].pairs);
    EXPECT_EQ(visited.points, of_ranks[0].points);
    EXPECT_EQ(visited.recorded, of_ranks[0].recorded);
    EXPECT_EQ(visited.forces, of_ranks[0].forces);
  }
}

TEST(PairsOfRun, AVisitThatFailsLeavesNoRankWaiting) {
  const Scene scene = tall_wall();
  std::mutex mutex;
  int ended = 0;
  step_on(3, scene, [&](Simulation& simulation, int rank) {
    // In the first message, in the last one, before the first one and never.
    for (const int failing : {0, 530, -1, 100000}) {
      PairsOfRun pairs = simulation.pairs_of_run();
      int visits = 0;
      const auto begin = [&](std::size_t) {
        if (failing < 0) throw std::runtime_error("full disk");
      };
      const auto visit_pair = [&](const PairKey&, const PairHistory&) {
        if (visits++ == failing) throw std::runtime_error("full disk");
      };
      if (rank == 0 && failing < 100000)
        EXPECT_THROW(pairs.visit_histories(begin, visit_pair), std::runtime_error);
      else
        EXPECT_NO_THROW(pairs.visit_histories(begin, visit_pair));
      if (rank > 0 || failing < 0)
        EXPECT_EQ(visits, 0);
      else if (failing < 100000)
        EXPECT_EQ(visits, failing + 1);
      else
        EXPECT_GT(visits, 531);
      // Records are left.
      pairs.finish();
      EXPECT_THROW(pairs.visit_records([](std::size_t) {}, [](const PairRecord&) {}), std::logic_error);
    }
    const std::lock_guard lock(mutex);
    ++ended;
  });
  EXPECT_EQ(ended, 3);
}

}  // namespace
}  // namespace ashlar::pairs_of_run_test

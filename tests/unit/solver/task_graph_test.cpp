#include "solver/task_graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace ashlar::task_graph_test {
namespace {

/// Two layers of ten tasks, each of the second one waits for all of the first one with the same parity, and one at the end.
struct Layers {
  TaskGraph graph;
  std::vector<std::vector<int>> after;
  Layers() {
    for (int k = 0; k < 10; ++k) add({});
    for (int k = 0; k < 10; ++k) add({k % 2, k % 2 + 2, k % 2 + 4, k % 2 + 6, k % 2 + 8});
    add({10, 11, 12, 13, 14, 15, 16, 17, 18, 19});
  }
  void add(const std::vector<int>& others) {
    EXPECT_EQ(graph.add(1.0, others), static_cast<int>(after.size()));
    after.push_back(others);
  }
};

TEST(TaskGraph, RunsEachTaskOnceAfterThoseItWaitsFor) {
  const Layers layers;
  ASSERT_EQ(layers.graph.size(), 21);
  for (const int threads : {1, 2, 3, 8, 40}) {
    for (int again = 0; again < 20; ++again) {
      std::vector<std::atomic<int>> runs(21);
      std::atomic<int> too_early = 0, wrong_worker = 0;
      layers.graph.run(threads, [&](int task, int worker) {
        for (const int other : layers.after[static_cast<std::size_t>(task)])
          too_early += runs[static_cast<std::size_t>(other)] == 1 ? 0 : 1;
        wrong_worker += worker < 0 || worker >= threads ? 1 : 0;
        ++runs[static_cast<std::size_t>(task)];
      });
      EXPECT_THAT(runs, testing::Each(testing::Eq(1)));
      EXPECT_EQ(too_early, 0);
      EXPECT_EQ(wrong_worker, 0);
    }
  }
}

TEST(TaskGraph, WorkersDoOneTaskAtATime) {
  TaskGraph graph;
  for (int k = 0; k < 200; ++k) (void)graph.add(1.0, {});
  std::vector<int> sums(4, 0);  // plain numbers, which the thread sanitizer watches
  graph.run(4, [&](int task, int worker) { sums[static_cast<std::size_t>(worker)] += task; });
  EXPECT_EQ(sums[0] + sums[1] + sums[2] + sums[3], 199 * 200 / 2);
}

TEST(TaskGraph, OneThreadKeepsTheOrderOfNumbers) {
  const Layers layers;
  std::vector<int> order;
  layers.graph.run(1, [&](int task, int) { order.push_back(task); });
  for (int k = 0; k < 21; ++k) EXPECT_EQ(order[static_cast<std::size_t>(k)], k);
}

TEST(TaskGraph, HasNoTasksToRun) {
  const TaskGraph none;
  none.run(3, [](int, int) { FAIL(); });
}

TEST(TaskGraph, PassesOnAnExceptionAndSkipsWhatWaits) {
  const Layers layers;
  for (const int threads : {1, 2, 8}) {
    std::atomic<int> later = 0;
    EXPECT_THROW(layers.graph.run(threads,
                                  [&](int task, int) {
                                    if (task == 1) throw std::runtime_error("no");
                                    if (task == 20 || (task > 9 && task % 2 == 1)) ++later;
                                  }),
                 std::runtime_error);
    EXPECT_EQ(later, 0);  // all of them wait for task 1
  }
}

}  // namespace
}  // namespace ashlar::task_graph_test

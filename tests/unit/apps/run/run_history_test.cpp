#include "apps/run/run_history.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "unit/apps/results/ended_run.hpp"

namespace ashlar::run_history_test {
namespace {

Run cube_with_measure() {
  return Run(test::loaded_scene(R"(
analysis = { end_time = 0.002, time_step = 1e-3, gravity = [0, 0, 0] }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
measure = [{ name = "centre", block = "cube", point = [0.5, 0.5, 0.5] }]
[[block]]
name = "cube"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 1] }
velocity = [1, 0, 0]
)"));
}

std::vector<Measure> measures(const Run& run) {
  return measures_of(run.whole(), run.simulation().blocks());
}

TEST(RunHistory, RowsHaveTheColumns) {
  const ashlar::Run run = cube_with_measure();
  RunHistory history(measures(run), true);
  history.add(run.simulation(), {}, 2);
  ASSERT_EQ(history.rows().size(), 1U);
  const std::vector<double>& row = history.rows().front();
  EXPECT_EQ(row.size(), history.columns(true).size());
  EXPECT_EQ(row.front(), 0.0) << "the step";
  EXPECT_EQ(row.back(), 2.0) << "the stage";
  EXPECT_EQ(history.columns(false).size() + 1, history.columns(true).size());
  EXPECT_EQ(history.goals()(run.simulation()).size(), 1U);
}

TEST(RunHistory, RowsThatAreNotKeptAreNotAdded) {
  const ashlar::Run run = cube_with_measure();
  RunHistory history(measures(run), false);
  history.add(run.simulation(), {}, 0);
  EXPECT_TRUE(history.rows().empty());
}

TEST(RunHistory, ARowNeedsItsBlocksAndAFrameAll) {
  const ashlar::Run run = cube_with_measure();
  RunHistory history(measures(run), false);
  history.share_needs({});
  EXPECT_EQ(history.needs(ResultFolder::Due::row).blocks, std::vector<int>{0});
  EXPECT_FALSE(history.needs(ResultFolder::Due::row).all);
  EXPECT_TRUE(history.needs(ResultFolder::Due::nothing).blocks.empty());
  EXPECT_FALSE(history.needs(ResultFolder::Due::nothing).all);
  EXPECT_TRUE(history.needs(ResultFolder::Due::frame).all);
}

}  // namespace
}  // namespace ashlar::run_history_test

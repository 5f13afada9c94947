#include "benchmarks/studies/cost_targets.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar::cost_targets_test {
namespace {

TEST(CostTargets, EveryFigureIsMeasured) {
  std::vector<std::string> told;
  const std::vector<CostFigure> figures =
      cost_figures({0.01}, [&](const CostFigure& figure) { told.push_back(figure.what); });
  ASSERT_FALSE(figures.empty());
  ASSERT_EQ(told.size(), figures.size());
  EXPECT_EQ(told.front(), figures.front().what);
  for (const CostFigure& figure : figures) {
    EXPECT_TRUE(std::isfinite(figure.measured)) << figure.what;
    EXPECT_GT(figure.target, 0.0) << figure.what;
  }
}

TEST(CostTargets, SpeedupsAreMetFromBelow) {
  EXPECT_EQ(target_line({"wall", 6.5, 4.0, ""}), "wall: 6.5 (target 4, missed)");
  EXPECT_EQ(target_line({"start", 0.7, 0.8, "s"}), "start: 0.7 s (target 0.8 s, met)");
  EXPECT_EQ(target_line({"threads", 1.8, 1.7, "", true}), "threads: 1.8 (target 1.7, met)");
  EXPECT_EQ(target_line({"lost", NAN, 1.0, "s"}), "lost: nan s (target 1 s, missed)");
}

TEST(CostTargets, TheMachineTakesSomeTime) {
  EXPECT_GT(machine_factor(), 0.0);
}

}  // namespace
}  // namespace ashlar::cost_targets_test

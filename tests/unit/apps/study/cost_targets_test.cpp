#include "apps/study/cost_targets.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar {
namespace {

TEST(CostTargets, EveryFigureIsMeasured) {
  const std::vector<CostFigure> figures = cost_figures({0.01});
  ASSERT_FALSE(figures.empty());
  for (const CostFigure& figure : figures) {
    EXPECT_TRUE(std::isfinite(figure.measured)) << figure.what;
    EXPECT_GT(figure.target, 0.0) << figure.what;
  }
}

TEST(CostTargets, SpeedupsAreMetFromBelow) {
  const std::vector<std::string> lines = target_lines({{"wall", 6.5, 4.0, ""},
                                                       {"start", 0.7, 0.8, "s"},
                                                       {"threads", 1.8, 1.7, "", true},
                                                       {"lost", NAN, 1.0, "s"}});
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0], "wall: 6.5 (target 4, missed)");
  EXPECT_EQ(lines[1], "start: 0.7 s (target 0.8 s, met)");
  EXPECT_EQ(lines[2], "threads: 1.8 (target 1.7, met)");
  EXPECT_EQ(lines[3], "lost: nan s (target 1 s, missed)");
}

TEST(CostTargets, TheMachineTakesSomeTime) {
  EXPECT_GT(machine_factor(), 0.0);
}

}  // namespace
}  // namespace ashlar

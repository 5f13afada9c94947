#include "apps/program/plot/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar::plot_test {
namespace {

TEST(Plot, SlopeOfAPowerLawIsItsExponent) {
  PlotSeries series{"y = 5 x^-2", {1, 10, 100, 1000}, {}};
  for (const double x : series.x) series.y.push_back(5.0 / (x * x));
  EXPECT_NEAR(last_slope(series), -2.0, 1e-12);
  EXPECT_TRUE(std::isnan(last_slope({"one point", {1}, {1}})));
  EXPECT_TRUE(std::isnan(last_slope({"no logarithms", {1, -2}, {0, 3}})));
}

}  // namespace
}  // namespace ashlar::plot_test

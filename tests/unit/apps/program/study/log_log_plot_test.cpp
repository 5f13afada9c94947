#include "apps/program/study/log_log_plot.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar {
namespace {

TEST(LogLogPlot, SlopeOfAPowerLawIsItsExponent) {
  PlotSeries series{"y = 5 x^-2", {1, 10, 100, 1000}, {}};
  for (const double x : series.x) series.y.push_back(5.0 / (x * x));
  EXPECT_NEAR(last_slope(series), -2.0, 1e-12);
  EXPECT_TRUE(std::isnan(last_slope({"one point", {1}, {1}})));
  EXPECT_TRUE(std::isnan(last_slope({"no logarithms", {1, -2}, {0, 3}})));
}

TEST(LogLogPlot, PointsLieWhereTheirLogarithmsSay) {
  // Axes from 10^0 to 10^2 and 10^-4 to 10^0: (10, 10^-2) is in the middle of the frame.
  const std::string svg = to_svg({"a < b", "x", "y", {{"series", {1, 10, 100}, {1e-4, 1e-2, 1}}}});
  EXPECT_NE(svg.find(R"(cx="365.0" cy="290.0")"), std::string::npos);
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_NE(svg.find("slope 2.00"), std::string::npos);
}

TEST(LogLogPlot, AxesEndAtOneTwoOrFiveTimesAPowerOfTen) {
  // From 20 to 500 and from 0.001 to 0.01: the first and the last point are in corners of the frame.
  const std::string svg = to_svg({"t", "x", "y", {{"s", {20, 60, 500}, {1e-3, 2e-3, 1e-2}}}, false});
  EXPECT_NE(svg.find(R"(cx="90.0" cy="530.0")"), std::string::npos);
  EXPECT_NE(svg.find(R"(cx="640.0" cy="50.0")"), std::string::npos);
  EXPECT_EQ(svg.find("slope"), std::string::npos);
  for (const char* label : {">20<", ">50<", ">100<", ">200<", ">500<", ">0.001<", ">0.007<", ">0.01<"})
    EXPECT_NE(svg.find(label), std::string::npos) << label;
  EXPECT_EQ(svg.find(">60<"), std::string::npos);
  // 13 decades: every second power of ten has a label.
  const std::string wide = to_svg({"t", "x", "y", {{"s", {1, 2}, {1e-13, 1}}}});
  EXPECT_NE(wide.find(R"(font-size="11">-12<)"), std::string::npos);
  EXPECT_EQ(wide.find(R"(font-size="11">-13<)"), std::string::npos);
}

TEST(LogLogPlot, LinearAxesGoFromTickToTick) {
  // x from 20 to 50 in steps of 5: (35, y) is in the middle. y from -1 to 0.5 in steps of 0.2: from -1 to 0.6.
  LogLogPlot plot{"t", "x", "y", {{"s", {20, 35, 50}, {-1, 0, 0.5}}}, false};
  plot.linear = true;
  const std::string svg = to_svg(plot);
  EXPECT_NE(svg.find(R"(cx="90.0" cy="530.0")"), std::string::npos);
  EXPECT_NE(svg.find(R"(cx="365.0" cy="230.0")"), std::string::npos);
  EXPECT_NE(svg.find(R"(cx="640.0" cy="80.0")"), std::string::npos);
  for (const char* label : {">20<", ">35<", ">-0.2<", ">0<", ">0.6<"})
    EXPECT_NE(svg.find(label), std::string::npos) << label;
  plot.series = {{"one point", {3}, {7}}};
  EXPECT_EQ(to_svg(plot).find("nan"), std::string::npos);
}

TEST(LogLogPlot, APlotWithoutPointsIsStillAPicture) {
  const std::string svg = to_svg({"empty", "x", "y", {{"nothing", {}, {}}}});
  EXPECT_TRUE(svg.starts_with("<svg"));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace ashlar

#include "apps/program/study/error_time_study.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/program/study/error_time_problems.hpp"

namespace ashlar::error_time_study_test {
namespace {

TEST(ErrorTimeStudy, HalfTheStepIsAQuarterOfTheErrorOfWhatTumbles) {
  const StudyResult result = study_error_time({2, 1, 2});
  EXPECT_TRUE(result.holds) << "chosen runs meet what is asked";
  ASSERT_EQ(result.columns.size(), 12U);
  // Curves of two steps: seven, four and six, and eight orders; six of two accuracies. Plate: eight orders, two accuracies;
  // sphere: one order; rocking, bars and sliding: two curves of two steps and two accuracies each.
  ASSERT_EQ(result.rows.size(), 2U * 17U + 8U + 2U * 6U + 8U + 2U + 1U + 3U * (2U * 2U + 2U));
  for (const PlotSeries& series : result.plot.series) {
    ASSERT_EQ(series.x.size(), series.y.size());
    if (series.name == "tumbling: order 0, dda" || series.name == "swelling: order 1, average") {
      EXPECT_NEAR(series.y[0] / series.y[1], 4.0, 1.0) << series.name;
    }
  }
  for (int problem = 1; problem <= 4; ++problem) {
    // Of two points on the front, the slower has the smaller error.
    double fastest = INFINITY;
    double error_of_fastest = 0.0;
    double least = INFINITY;
    bool least_is_on_front = false;
    for (const auto& row : result.rows) {
      if (row[0] != problem || !std::isfinite(row[7])) continue;
      if (row[8] < fastest) {
        fastest = row[8];
        error_of_fastest = row[9];
      }
      // Two may have the same error; the faster one is on the front.
      if (row[7] < least) least_is_on_front = false;
      if (row[7] <= least) {
        least = row[7];
        least_is_on_front = least_is_on_front || row[9] == 1.0;
      }
    }
    EXPECT_EQ(error_of_fastest, 1.0) << problem;
    EXPECT_TRUE(least_is_on_front) << problem;
  }
}

// r = 40 m/s^3, h = 1/8 s, t0 = 3/40 s: v = 5/8 m/s, w = 0.5125 m/s; 5/64 + 0.0440625 + 0.2626.../6 m.
TEST(ErrorTimeStudy, DistanceOfAPulse) {
  EXPECT_NEAR(slide_of_pulse({8.0, 3.0, 0.4}), 0.078125 + 0.0440625 + 0.5125 * 0.5125 / 6.0, 1e-12);
}

// At the given orders all of the error is that of the step.
TEST(ErrorTimeStudy, ABlockSlidesAsFarAsAPulseDrivesIt) {
  EXPECT_LT(sliding_error({0, Integrator::average_acceleration, false, false, 1e-3}), 1e-2);
}

// The crown sinks less with stiffer functions: each order comes closer to the reference.
TEST(ErrorTimeStudy, OrdersOfAnArchApproachItsReference) {
  EXPECT_LT(arch_reference().error, 1e-2);
  EXPECT_LT(arch_error({3}), arch_error({1}));
}

}  // namespace
}  // namespace ashlar::error_time_study_test

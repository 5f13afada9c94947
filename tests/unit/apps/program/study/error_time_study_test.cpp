#include "apps/program/study/error_time_study.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar::error_time_study_test {
namespace {

TEST(ErrorTimeStudy, HalfTheStepIsAQuarterOfTheErrorOfWhatTumbles) {
  const StudyResult result = study_error_time({2, 1, 2});
  EXPECT_TRUE(result.holds) << "chosen runs meet what is asked";
  ASSERT_EQ(result.columns.size(), 12U);
  // Curves of two steps: seven, four and six, and eight orders; six of two accuracies. Plate: eight orders, two accuracies;
  // sphere: one order; rocking and bars: two curves of two steps each; bars: two accuracies.
  ASSERT_EQ(result.rows.size(), 2U * 17U + 8U + 2U * 6U + 8U + 2U + 1U + 2U * 4U + 2U);
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

}  // namespace
}  // namespace ashlar::error_time_study_test

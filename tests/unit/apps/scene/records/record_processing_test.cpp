#include "apps/scene/records/record_processing.hpp"

#include <gtest/gtest.h>

namespace ashlar::record_processing_test {
namespace {

using Rows = std::vector<std::vector<double>>;

TEST(RecordProcessing, BaselineIsThePolynomialOfLeastSquares) {
  // t^2 at t = 4, 5, 6 about 5: mean 2/3 of (1, 0, 1), and a line through 5 that takes 10 (t - 5).
  Rows rows{{4.0, 16.0, 1.0}, {5.0, 25.0, 1.0}, {6.0, 36.0, 1.0}};
  Rows mean = rows;
  remove_baseline(mean, 0);
  for (const auto& [k, value] :
       {std::pair(0U, 16.0 - 77.0 / 3.0), {1U, 25.0 - 77.0 / 3.0}, {2U, 36.0 - 77.0 / 3.0}}) {
    EXPECT_NEAR(mean[k][1], value, 1e-13);
    EXPECT_NEAR(mean[k][2], 0.0, 1e-15);
  }
  remove_baseline(rows, 1);
  EXPECT_NEAR(rows[0][1], 1.0 / 3.0, 1e-13);
  EXPECT_NEAR(rows[1][1], -2.0 / 3.0, 1e-13);
  EXPECT_NEAR(rows[2][1], 1.0 / 3.0, 1e-13);
  EXPECT_EQ(rows[2][0], 6.0);
}

TEST(RecordProcessing, BaselineOfItsOwnOrderLeavesNothing) {
  for (int order = 0; order <= largest_baseline_order; ++order) {
    Rows rows;
    for (int k = 0; k < 50; ++k) {
      const double t = 0.02 * k * k;
      double value = 3.0;
      if (order >= 1) value -= 2.0 * t;
      if (order >= 2) value += 0.3 * t * t;
      if (order >= 3) value += 0.01 * t * t * t;
      rows.push_back({t, value});
    }
    remove_baseline(rows, order);
    for (const auto& row : rows) EXPECT_NEAR(row[1], 0.0, 1e-9) << order;
  }
}

TEST(RecordProcessing, ResamplingIsLinearAndKeepsTheEnd) {
  const Rows rows{{1.0, 0.0, 5.0}, {2.0, 10.0, 5.0}, {4.0, 30.0, 1.0}};
  EXPECT_EQ(resampled(rows, 0.75),
            (Rows{{1.0, 0.0, 5.0}, {1.75, 7.5, 5.0}, {2.5, 15.0, 4.0}, {3.25, 22.5, 2.5}, {4.0, 30.0, 1.0}}));
  EXPECT_EQ(resampled(rows, 2.0), (Rows{{1.0, 0.0, 5.0}, {3.0, 20.0, 3.0}, {4.0, 30.0, 1.0}}));
  EXPECT_EQ(resampled({{2.0, 1.0}}, 0.1), (Rows{{2.0, 1.0}}));
}

}  // namespace
}  // namespace ashlar::record_processing_test

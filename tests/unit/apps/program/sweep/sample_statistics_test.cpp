#include "apps/program/sweep/sample_statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace ashlar::sample_statistics_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(SampleStatistics, AreThoseOfTheSample) {
  const SampleStatistics statistics = statistics_of({2.0, {}, 0.5, 1.0, 0.9}, 1.0);
  EXPECT_EQ(statistics.count, 4U);
  EXPECT_EQ(statistics.missing, 1U);
  EXPECT_DOUBLE_EQ(statistics.mean, 1.1);
  EXPECT_NEAR(statistics.deviation, std::sqrt((0.81 + 0.36 + 0.01 + 0.04) / 3.0), 1e-12);
  EXPECT_EQ(statistics.least, 0.5);
  EXPECT_EQ(statistics.most, 2.0);
  EXPECT_EQ(statistics.share_below, 0.5);  // 1 is not below 1
  EXPECT_DOUBLE_EQ(statistics.share_error, 0.25);
  EXPECT_EQ(statistics_of({}, 1.0).count, 0U);
  EXPECT_THAT(to_string(statistics, "load_factor.lower", 1.0),
              HasSubstr("50 % below 1 (standard error 25 %); 1 without"));
  EXPECT_THAT(to_string(statistics, "time", 1.0), Not(HasSubstr("below")));
}

SweepTable table() {
  return {{"phi", "dip", "folder", "status", "factor_of_safety.lower", "factor_of_safety.upper"},
          {{"30.1", "20", "a", "completed", "1.2", "1.21"},
           {"28.9", "20", "b", "completed", "", "0.1"},
           {"27.2", "20", "e", "not converged", "", "0.1"},
           {"30.1", "25", "c", "completed", "10", ""},
           {"28.9", "25", "d", "failed", "", ""}}};
}

std::vector<VariedKey> keys() {
  return {parse_varied_key("phi=normal(30,1)"), parse_varied_key("dip=20,25")};
}

TEST(SampleStatistics, SamplesAreGroupedByListedValues) {
  const std::vector<SampleGroup> groups = sample_groups(keys(), table(), "factor_of_safety.lower", 1.0);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].name, "dip = 20");
  // If the smallest factor moves already, the factor is at most that; a search without an answer has none.
  EXPECT_EQ(groups[0].values, (std::vector<std::optional<double>>{1.2, 0.1, std::nullopt}));
  EXPECT_EQ(groups[1].values, (std::vector<std::optional<double>>{10.0, std::nullopt}));
  // The least factor that is tried may be above the limit: it is not known on which side of it the sample is.
  EXPECT_FALSE(sample_groups(keys(), table(), "factor_of_safety.lower", 0.05)[0].values[1]);
  EXPECT_THROW((void)sample_groups(keys(), table(), "other", 1.0), std::invalid_argument);
}

TEST(SampleStatistics, AHistogramCountsEachSampleOnce) {
  const Plot plot = histogram_of({{"", {1.0, 1.0, 1.0}}, {"b", {1.0, {}, 2.0}}}, "f");
  ASSERT_EQ(plot.series.size(), 2U);
  EXPECT_THAT(plot.series[0].name, HasSubstr("3 samples"));
  EXPECT_EQ(*std::max_element(plot.series[0].y.begin(), plot.series[0].y.end()), 3.0);
  EXPECT_THAT(plot.series[1].name, HasSubstr("b: 2 samples"));
  EXPECT_EQ(*std::max_element(plot.series[1].y.begin(), plot.series[1].y.end()), 1.0);
  EXPECT_TRUE(histogram_of({}, "f").series.empty());
}

}  // namespace
}  // namespace ashlar::sample_statistics_test

#include "apps/results/tables/thinned_series.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ashlar::thinned_series_test {
namespace {

using ::testing::ElementsAre;

std::vector<std::size_t> kept(std::size_t count, std::size_t limit, std::set<std::size_t> always) {
  ThinnedSeries<int> series(limit, std::move(always));
  for (std::size_t i = 0; i < count; ++i) series.add(i, 0, 10);
  std::vector<std::size_t> indices;
  for (const auto& item : series.items()) indices.push_back(item.index);
  return indices;
}

TEST(ThinnedSeries, KeepsAllThatFits) {
  EXPECT_THAT(kept(4, 40, {3}), ElementsAre(0, 1, 2, 3));
}

// Five items of ten do not go into 40: every second one; nine of those do not either: every fourth.
TEST(ThinnedSeries, KeepsEverySecondOrFourth) {
  EXPECT_THAT(kept(5, 40, {}), ElementsAre(0, 2, 4));
  EXPECT_THAT(kept(9, 40, {}), ElementsAre(0, 4, 8));
}

TEST(ThinnedSeries, KeepsWhatIsNamed) {
  EXPECT_THAT(kept(10, 40, {3, 9}), ElementsAre(0, 3, 8, 9));
  EXPECT_THAT(kept(10, 1, {3, 9}), ElementsAre(0, 3, 9));
}

TEST(ThinnedSeries, SaysWhatItWants) {
  ThinnedSeries<int> series(20, {5});
  for (std::size_t i = 0; i < 3; ++i) series.add(i, 0, 10);  // now 0 and 2
  EXPECT_EQ(series.total_cost(), 20U);
  EXPECT_FALSE(series.wants(3));
  EXPECT_TRUE(series.wants(4));
  EXPECT_TRUE(series.wants(5));
}

}  // namespace
}  // namespace ashlar::thinned_series_test

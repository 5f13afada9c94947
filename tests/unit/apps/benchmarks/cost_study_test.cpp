#include "benchmarks/studies/cost_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace ashlar::cost_study_test {
namespace {

TEST(CostStudy, ScenesHaveTheBlocksTheyAreNamedFor) {
  CostStudySize size;
  size.most_blocks = 100;
  size.most_order = 2;
  size.steps = 2;
  const StudyResult result = study_cost(size, [](const std::string&) {});
  EXPECT_TRUE(result.holds);
  ASSERT_EQ(result.columns.size(), 8U);
  std::map<std::pair<int, int>, std::vector<double>> rows;
  for (const auto& row : result.rows) {
    ASSERT_EQ(row.size(), result.columns.size());
    rows[{static_cast<int>(row[0]), static_cast<int>(row[1])}] = row;
    EXPECT_GT(row[6], 0.0);
  }
  // 8 x 8 cubes; 8 courses of 8 and 9 in turn; 4^3; 36 + 25 + 16 + 9 + 4 + 1; one cube of 4 and of 10 functions.
  const std::map<std::pair<int, int>, std::pair<double, double>> expected = {
      {{1, 8}, {64, 768}},  {{2, 8}, {68, 816}}, {{3, 4}, {64, 768}},
      {{4, 6}, {91, 1092}}, {{5, 1}, {1, 12}},   {{5, 2}, {1, 30}}};
  for (const auto& [name, counts] : expected) {
    ASSERT_TRUE(rows.contains(name)) << name.first << ' ' << name.second;
    EXPECT_EQ(rows[name][2], counts.first);
    EXPECT_EQ(rows[name][3], counts.second);
  }
  EXPECT_EQ(rows.size(), expected.size());
}

}  // namespace
}  // namespace ashlar::cost_study_test

// Limits of runs.
#include "apps/program/fragility/limit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace ashlar::limit_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const std::vector<std::string> columns = {"step",         "time",           "top.ux",
                                          "storey.drift", "storey.drift_x", "stone 1.uz"};

double demand(const std::string& text, const std::vector<double>& row) {
  return demand_of_row(parse_limit(text), columns)(row);
}

TEST(Limit, IsAComparisonOfAFormulaOfColumnsWithANumber) {
  const Limit limit = parse_limit(" abs(top.ux) - 2*time >= 1e-2/2 ");
  EXPECT_EQ(limit.text, "abs(top.ux) - 2*time >= 1e-2/2");
  EXPECT_EQ(limit.demand, "abs(top.ux) - 2*time");
  EXPECT_DOUBLE_EQ(limit.bound, 0.005);
  EXPECT_TRUE(limit.above);
  EXPECT_TRUE(limit.exceeded_by(0.005));
  EXPECT_FALSE(limit.exceeded_by(0.004));
  EXPECT_DOUBLE_EQ(demand("abs(top.ux) - 2*time > 0", {7, 0.5, -3, 0, 0, 0}), 2.0);
  EXPECT_DOUBLE_EQ(demand("'stone 1.uz' < -1", {7, 0.5, -3, 0, 0, -4}), -4.0);
}

TEST(Limit, BelowIsTheOtherSide) {
  const Limit limit = parse_limit("top.ux < -0.5");
  EXPECT_TRUE(limit.exceeded_by(-0.6));
  EXPECT_FALSE(limit.exceeded_by(-0.5));
  EXPECT_DOUBLE_EQ(limit.worse(1.0, -2.0), -2.0);
  EXPECT_DOUBLE_EQ(parse_limit("top.ux > 1").worse(1.0, -2.0), 1.0);
  EXPECT_DOUBLE_EQ(limit.worse(std::nan(""), 3.0), 3.0);
  EXPECT_FALSE(limit.exceeded_by(std::nan("")));
}

TEST(Limit, ADriftGoesByItsName) {
  EXPECT_DOUBLE_EQ(demand("storey > 0.02", {0, 0, 0, 0.03, -0.03, 0}), 0.03);
}

TEST(Limit, ARowWithoutAValueHasNoDemand) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(demand("2*top.ux > 1", {0, 0, nan, 0, 0, 0})));
  EXPECT_TRUE(std::isnan(demand("1/top.ux > 1", {0, 0, 0, 0, 0, 0})));
}

TEST(Limit, CollapseHasNoDemand) {
  EXPECT_TRUE(parse_limit("collapse").is_collapse());
  EXPECT_TRUE(std::isnan(demand("collapse", {0, 0, 0, 0, 0, 0})));
}

TEST(Limit, FaultsAreTold) {
  const auto refusal = [](const std::string& text, const std::string& words) {
    EXPECT_THAT(
        [&] {
          (void)demand(text, {0, 0, 0, 0, 0, 0});
        },
        ThrowsMessage<std::invalid_argument>(HasSubstr(words)))
        << text;
  };
  refusal("top.ux", "limit has 0 comparisons, one of > >= < <= is needed");
  refusal("0 < top.ux < 1", "limit has 2 comparisons");
  refusal("top.ux >", "a side of the comparison is empty");
  refusal("top.ux > much", "the right side (much) is no number: unknown name");
  refusal("top.uy > 1", "no column of history.csv has that name (top.uy), did you mean top.ux?");
  refusal("2 > 1", "the left side has no column of history.csv (2)");
  refusal("top.ux + > 1", "formula cannot be read");
  refusal("'top.ux > 1", "limit has 0 comparisons");
}

}  // namespace
}  // namespace ashlar::limit_test

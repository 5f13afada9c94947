#include "apps/run/answers/factor_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ashlar::factor_search_test {
namespace {

/// Blocks that stand below a limit; trials within a relative distance of it are unknown.
struct Slope {
  double limit = 1.0;
  double unknown = 0.0;
  std::vector<double> tried = {};

  std::optional<FactorTrial> operator()(double factor) {
    tried.push_back(factor);
    FactorTrial trial{factor, factor < limit ? TrialOutcome::stands : TrialOutcome::moves, 7};
    if (std::abs(factor - limit) < unknown * limit) trial.outcome = TrialOutcome::unknown;
    return trial;
  }
};

TEST(FactorSearch, BracketsTheLimitToTheTolerance) {
  for (const double limit : {0.11, 0.77, 1.0000001, 2.62, 9.9}) {
    for (const double tolerance : {0.3, 0.01, 1e-4}) {
      Slope slope{limit};
      const FactorBracket bracket = find_factor({{"*"}, tolerance, 0.1, 10.0}, std::ref(slope));
      ASSERT_TRUE(bracket.resolved && bracket.lower && bracket.upper) << limit;
      EXPECT_LT(*bracket.lower, limit);
      EXPECT_GE(*bracket.upper, limit);
      EXPECT_LE(*bracket.upper, *bracket.lower * (1.0 + tolerance));
      EXPECT_EQ(bracket.trials.size(), slope.tried.size());
      EXPECT_EQ(slope.tried.front(), 1.0);
      // From a factor of two: log2(ln 2 / ln(1 + tolerance)) halvings after at most five trials.
      EXPECT_LE(static_cast<double>(slope.tried.size()),
                6.0 + std::log2(std::log(2.0) / std::log1p(tolerance)));
      EXPECT_FALSE(bracket.interrupted);
    }
  }
}

TEST(FactorSearch, WhatIsExpectedIsTriedFirst) {
  Slope right{1.502};
  const FactorBracket two = find_factor({{"*"}, 0.01, 0.1, 10.0}, std::ref(right), ExpectedFactor{1.5, 1.51});
  EXPECT_TRUE(two.resolved);
  EXPECT_EQ(two.lower, 1.5);
  EXPECT_EQ(two.upper, 1.51);
  EXPECT_EQ(right.tried, (std::vector<double>{1.5, 1.51}));
  // Wrong on either side, or without an answer at its ends, it does no harm.
  for (const double limit : {0.3, 1.49, 1.505, 1.53, 6.0}) {
    for (const double unknown : {0.0, 0.004}) {
      Slope slope{limit, unknown};
      const FactorBracket bracket =
          find_factor({{"*"}, 0.02, 0.1, 10.0}, std::ref(slope), ExpectedFactor{1.5, 1.51});
      ASSERT_TRUE(bracket.resolved && bracket.lower && bracket.upper) << limit << ' ' << unknown;
      EXPECT_LT(*bracket.lower, limit);
      EXPECT_GE(*bracket.upper, limit);
      EXPECT_LE(*bracket.upper, *bracket.lower * 1.02);
    }
  }
}

// A tolerance that no two numbers are within is met where no number is left between them.
TEST(FactorSearch, EndsAtNeighbouringNumbers) {
  for (const double limit : {1.5862568514200606, 1.0, 0.3}) {
    Slope slope{limit};
    const FactorBracket bracket = find_factor({{"*"}, 1e-300, 0.1, 10.0}, std::ref(slope));
    ASSERT_TRUE(bracket.resolved && bracket.lower && bracket.upper) << limit;
    EXPECT_EQ(*bracket.upper, limit);
    EXPECT_EQ(*bracket.lower, std::nextafter(limit, 0.0));
    EXPECT_LE(slope.tried.size(), 70U);
  }
}

TEST(FactorSearch, StaysInItsRangeAndSaysWhatIsBeyond) {
  for (const double limit : {0.01, 100.0}) {
    Slope slope{limit};
    const FactorBracket bracket = find_factor({{"*"}, 0.01, 0.3, 7.0}, std::ref(slope));
    EXPECT_TRUE(bracket.resolved);
    EXPECT_EQ(bracket.lower, limit > 1.0 ? std::optional(7.0) : std::nullopt);
    EXPECT_EQ(bracket.upper, limit > 1.0 ? std::nullopt : std::optional(0.3));
    for (const double factor : slope.tried) EXPECT_TRUE(factor >= 0.3 && factor <= 7.0) << factor;
  }
  // A range without 1 starts at its end nearest to 1.
  Slope slope{3.0};
  EXPECT_TRUE(find_factor({{"*"}, 0.01, 2.0, 4.0}, std::ref(slope)).resolved);
  EXPECT_EQ(slope.tried.front(), 2.0);
}

TEST(FactorSearch, GoesAroundWhatTrialsDoNotTell) {
  // Nothing is known within 0.3 % of the limit: a bracket of 1 % can still be had.
  for (const double limit : {0.35, 1.0, 1.41, 2.62}) {
    Slope slope{limit, 0.003};
    const FactorBracket bracket = find_factor({{"*"}, 0.01, 0.1, 10.0}, std::ref(slope));
    EXPECT_TRUE(bracket.resolved) << limit;
    EXPECT_LT(*bracket.lower, limit);
    EXPECT_GT(*bracket.upper, limit);
  }
}

TEST(FactorSearch, IsUnresolvedWhereTrialsTellNothing) {
  Slope slope{1.3, 0.1};
  const FactorBracket bracket = find_factor({{"*"}, 0.01, 0.1, 10.0}, std::ref(slope));
  EXPECT_FALSE(bracket.resolved);
  // As near to what is not known as can be told.
  EXPECT_LE(*bracket.lower, 1.3 * 0.9);
  EXPECT_GE(*bracket.lower, 1.3 * 0.9 / 1.0025);
  EXPECT_GE(*bracket.upper, 1.3 * 1.1);
  EXPECT_LE(*bracket.upper, 1.3 * 1.1 * 1.0025);
  Slope nothing{1.0, 100.0};
  EXPECT_FALSE(find_factor({}, std::ref(nothing)).lower);
  // Halved to 0.1, doubled to 10.
  EXPECT_EQ(nothing.tried.size(), 9U);
}

TEST(FactorSearch, EndsWhenToldTo) {
  int left = 4;
  const FactorBracket bracket = find_factor({}, [&](double factor) -> std::optional<FactorTrial> {
    if (left-- == 0) return std::nullopt;
    return FactorTrial{factor, TrialOutcome::stands, 1};
  });
  EXPECT_TRUE(bracket.interrupted);
  EXPECT_FALSE(bracket.resolved);
  EXPECT_EQ(bracket.trials.size(), 4U);
}

}  // namespace
}  // namespace ashlar::factor_search_test

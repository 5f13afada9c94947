// The search for a limit, on trials whose limit is known.
#include "solver/limit/limit_trial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ashlar::limit_trial_test {
namespace {

/// Trials of a limit, with an estimate of it that is off by a factor; 0: none.
struct Trials {
  double limit;
  double off = 0.0;
  std::vector<double> tried = {};

  LimitAttempt attempt() {
    return [this](double factor) -> std::optional<LimitTrial> {
      tried.push_back(factor);
      LimitTrial trial;
      trial.factors.strength = factor;
      trial.outcome = factor < limit ? LimitOutcome::stands : LimitOutcome::moves;
      if (factor >= limit) trial.estimate = off * limit;
      return trial;
    };
  }
};

void expect_bracket(const LimitBracket& bracket, double limit, double tolerance) {
  ASSERT_TRUE(bracket.lower && bracket.upper);
  EXPECT_TRUE(bracket.resolved);
  EXPECT_LT(*bracket.lower, limit);
  EXPECT_GE(*bracket.upper, limit);
  EXPECT_LE(*bracket.upper, *bracket.lower * (1.0 + tolerance));
  EXPECT_EQ(bracket.motion->factors.strength, *bracket.upper);
}

TEST(LimitTrial, ASearchNarrowsAroundTheLimit) {
  for (const double limit : {0.11, 0.7, 1.0001, 3.0, 9.9}) {
    for (const double off : {0.0, 1.0, 1.0005, 0.9995, 0.5, 3.0}) {
      LimitBracket bracket;
      Trials trials{limit, off};
      narrow(bracket, {0.1, 10.0, 1e-3}, 1.0, 0.0, 2.0, trials.attempt());
      expect_bracket(bracket, limit, 1e-3);
    }
  }
}

TEST(LimitTrial, GoodEstimatesSaveTrials) {
  Trials without{2.7}, with{2.7, 1.0};
  LimitBracket bracket;
  narrow(bracket, {0.1, 10.0, 1e-4}, 1.0, 0.0, 2.0, without.attempt());
  bracket = {};
  narrow(bracket, {0.1, 10.0, 1e-4}, 1.0, 0.0, 2.0, with.attempt());
  expect_bracket(bracket, 2.7, 1e-4);
  EXPECT_LE(with.tried.size(), 5U);
  EXPECT_GE(without.tried.size(), 10U);
}

TEST(LimitTrial, ALimitOutsideTheSearchHasOneEnd) {
  LimitBracket above;
  Trials high{20.0};
  narrow(above, {0.1, 10.0, 1e-3}, 1.0, 0.0, 2.0, high.attempt());
  EXPECT_TRUE(above.resolved);
  EXPECT_EQ(above.lower, 10.0);
  EXPECT_FALSE(above.upper);
  LimitBracket below;
  Trials low{0.01};
  narrow(below, {0.1, 10.0, 1e-3}, 1.0, 0.0, 2.0, low.attempt());
  EXPECT_TRUE(below.resolved);
  EXPECT_FALSE(below.lower);
  EXPECT_EQ(below.upper, 0.1);
}

TEST(LimitTrial, AMotionIsFollowedInStridesFromWhatIsKnown) {
  LimitBracket bracket;
  bracket.upper = 8.0;
  bracket.motion.emplace().factors.strength = 8.0;
  Trials trials{1.0, 0.3};
  narrow(bracket, {0.1, 10.0, 1e-3}, 7.0, 0.0, 1.25, trials.attempt());
  expect_bracket(bracket, 1.0, 1e-3);
  double lowest = 8.0;
  for (const double factor : trials.tried) {
    EXPECT_GE(factor, lowest / 1.25 * (1.0 - 1e-12));
    if (factor >= 1.0) lowest = std::min(lowest, factor);
  }
}

TEST(LimitTrial, ASearchWithoutAnswersEnds) {
  LimitBracket bracket;
  int count = 0;
  narrow(bracket, {0.1, 10.0, 1e-3}, 1.0, 0.0, 2.0, [&](double) {
    ++count;
    return LimitTrial{};
  });
  EXPECT_FALSE(bracket.resolved);
  EXPECT_FALSE(bracket.lower || bracket.upper);
  EXPECT_LT(count, 20);
  narrow(bracket, {0.1, 10.0, 1e-3}, 1.0, 0.0, 2.0, [](double) { return std::nullopt; });
  EXPECT_FALSE(bracket.resolved);
}

}  // namespace
}  // namespace ashlar::limit_trial_test

#include "apps/run/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace ashlar::progress_test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

// A progress line on a string, with a clock that the test sets.
class ProgressTest : public testing::Test {
 protected:
  ProgressLine line(ProgressMode mode, double end_time = 10.0) {
    return ProgressLine(end_time, mode, out_, [this] { return now_; });
  }
  static ProgressState step(std::int64_t number) {
    return {number, 0.1 * static_cast<double>(number), 0.1, 4, 2};
  }
  [[nodiscard]] long count(char c) const {
    const std::string text = out_.str();
    return std::count(text.begin(), text.end(), c);
  }

  std::ostringstream out_;
  double now_ = 1000.0;
};

TEST(FormatProgress, NamesEverything) {
  const ProgressState state{950, 0.95, 1e-3, 4, 2};
  EXPECT_EQ(format_progress(state, 1.35, 65.2),
            "step 950  t = 0.95 / 1.35 s  dt = 0.001 s  contacts 4  open-close 2  left 1:06");
  EXPECT_EQ(format_progress(state, 1.35, std::nullopt),
            "step 950  t = 0.95 / 1.35 s  dt = 0.001 s  contacts 4  open-close 2");
  EXPECT_THAT(format_progress(state, 1.35, 7384.0), EndsWith("left 2:03:04"));
  EXPECT_THAT(format_progress(state, 1.35, 0.0), EndsWith("left 0:00"));
}

TEST_F(ProgressTest, IsSilentWhenAskedTo) {
  {
    ProgressLine progress = line(ProgressMode::silent);
    progress.update(step(1));
    now_ += 1000.0;
    progress.update(step(2));
  }
  EXPECT_EQ(out_.str(), "");
}

TEST_F(ProgressTest, PlainLinesAreSparseAndHaveTheLastStep) {
  {
    ProgressLine progress = line(ProgressMode::plain);
    for (int number = 1; number <= 100; ++number) {
      now_ += 0.07;
      progress.update(step(number));
    }
    progress.finish();
    progress.finish();
  }
  // 7 s: one line after 5 s, one at the end.
  EXPECT_EQ(count('\n'), 2);
  EXPECT_EQ(count('\r'), 0);
  EXPECT_THAT(out_.str(), HasSubstr("step 100  t = 10 / 10 s"));
}

TEST_F(ProgressTest, DoesNotRepeatTheLastStep) {
  ProgressLine progress = line(ProgressMode::plain);
  now_ += 6.0;
  progress.update(step(1));
  progress.finish();
  EXPECT_EQ(count('\n'), 1);
}

TEST_F(ProgressTest, LiveLineIsRewrittenInPlaceAndEnded) {
  {
    ProgressLine progress = line(ProgressMode::live);
    for (int number = 1; number <= 100; ++number) {
      progress.update(step(number));
      now_ += 0.03;
    }
    EXPECT_EQ(count('\n'), 0);
  }
  // 2.97 s at most ten times a second, and the last.
  EXPECT_GE(count('\r'), 20);
  EXPECT_LE(count('\r'), 31);
  EXPECT_THAT(out_.str(), HasSubstr("step 100 "));
  EXPECT_THAT(out_.str(), EndsWith("\n"));
  EXPECT_EQ(count('\n'), 1);
}

TEST_F(ProgressTest, TimeLeftFollowsTheSpeedSinceTheFirstStep) {
  ProgressLine progress = line(ProgressMode::live);
  now_ += 100.0;  // what happens before the first step says nothing about the speed of steps
  progress.update(step(10));
  EXPECT_THAT(out_.str(), Not(HasSubstr("left")));
  now_ += 3.0;
  progress.update(step(40));
  // 3 s of simulation took 3 s of wall time, 6 s of simulation are left.
  EXPECT_THAT(out_.str(),
              HasSubstr("step 40  t = 4 / 10 s  dt = 0.1 s  contacts 4  open-close 2  left 0:06"));
}

TEST_F(ProgressTest, WritesNothingWithoutSteps) {
  line(ProgressMode::live).finish();
  line(ProgressMode::plain).finish();
  EXPECT_EQ(out_.str(), "");
}

TEST(ProgressMode, QuietWins) {
  EXPECT_EQ(choose_progress_mode(true), ProgressMode::silent);
}

}  // namespace
}  // namespace ashlar::progress_test

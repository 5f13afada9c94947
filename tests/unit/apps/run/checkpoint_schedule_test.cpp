#include "apps/run/checkpoint_schedule.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ashlar::checkpoint_schedule_test {
namespace {

/// Seconds at which a run with steps of a quarter of a second saves itself, in no time.
std::vector<double> saved_at(CheckpointSchedule schedule, double end) {
  std::vector<double> times;
  for (double now = 0.25; now <= end; now += 0.25) {
    if (!schedule.due(now)) continue;
    times.push_back(now);
    schedule.saved(now, now);
  }
  return times;
}

TEST(CheckpointSchedule, BeginsInTheFirstSecondAndGrowsToAMinute) {
  EXPECT_EQ(saved_at(CheckpointSchedule({}, 0.0), 250.0),
            (std::vector<double>{1, 3, 7, 15, 31, 63, 123, 183, 243}));
}

TEST(CheckpointSchedule, KeepsAGivenDistance) {
  EXPECT_EQ(saved_at(CheckpointSchedule(2.5, 0.0), 10.0), (std::vector<double>{2.5, 5, 7.5, 10}));
  EXPECT_EQ(saved_at(CheckpointSchedule(0.0, 0.0), 1.0), (std::vector<double>{0.25, 0.5, 0.75, 1}));
}

TEST(CheckpointSchedule, CountsFromWhenTheLastOneWasWritten) {
  CheckpointSchedule schedule(1.0, 100.0);
  EXPECT_FALSE(schedule.due(100.5));
  EXPECT_TRUE(schedule.due(101.0));
  schedule.saved(101.0, 103.0);
  EXPECT_FALSE(schedule.due(103.5));
  EXPECT_TRUE(schedule.due(104.0)) << "a given distance is kept whatever it costs";
}

// With 0.6 s spent, 0.6 s for the next one and 0.6 s for that of the end are 3 % of 60 s; with 1.2 s spent it is 80 s.
TEST(CheckpointSchedule, AllTogetherTakeAtMostThreePercent) {
  CheckpointSchedule schedule({}, 0.0);
  schedule.saved(0.0, 0.6);
  schedule.begin(0.6);
  EXPECT_FALSE(schedule.due(59.9));
  EXPECT_TRUE(schedule.due(60.1));
  schedule.saved(60.1, 60.7);
  EXPECT_FALSE(schedule.due(79.9));
  EXPECT_TRUE(schedule.due(80.1));
}

// 2 * 0.1 s are 3 % of 6.7 s, 2 * 0.2 s of 13.3 s.
TEST(CheckpointSchedule, AStateThatHasGrownIsExpectedToTakeLonger) {
  const CheckpointSchedule schedule({}, 0.0);
  EXPECT_TRUE(schedule.due(10.0, 0.1));
  EXPECT_FALSE(schedule.due(10.0, 0.2));
  EXPECT_TRUE(schedule.due(14.0, 0.2));
}

// Steps of 0.5 s, checkpoints of 0.7 s: the share is kept to the end, at which one more is written, wherever that is.
TEST(CheckpointSchedule, TheLastOneIsInTheShare) {
  constexpr double step = 0.5, cost = 0.7, start = 0.01;
  CheckpointSchedule schedule({}, 0.0);
  schedule.saved(0.0, start);
  schedule.begin(start);
  double now = start, spent = start;
  int count = 0;
  while (now < 500.0) {
    now += step;
    if (!schedule.due(now, count == 0 ? cost - start : 0.0)) continue;
    schedule.saved(now, now + cost);
    now += cost;
    spent += cost;
    ++count;
    EXPECT_LE(spent + cost, CheckpointSchedule::largest_share * now + 1e-12) << now;
  }
  // One each 0.7 s / 0.03 = 23.3 s, until intervals of 32 and 60 s are longer: at 47, 70, 94, 117, 140, 174, 235, ... 478 s.
  EXPECT_EQ(count, 11);
}

TEST(CheckpointSchedule, IntervalsBeginAgainWithAStage) {
  CheckpointSchedule schedule({}, 0.0);
  for (const double now : {1.0, 3.0, 7.0}) {
    EXPECT_TRUE(schedule.due(now));
    schedule.saved(now, now);
  }
  EXPECT_FALSE(schedule.due(9.0)) << "8 s after the last one";
  schedule.begin(8.0);
  EXPECT_TRUE(schedule.due(9.0));
}

}  // namespace
}  // namespace ashlar::checkpoint_schedule_test

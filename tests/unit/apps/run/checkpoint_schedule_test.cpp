#include "apps/run/checkpoint_schedule.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ashlar::checkpoint_schedule_test {
namespace {

/// Seconds at which a run with steps of a quarter of a second saves itself.
std::vector<double> saved_at(CheckpointSchedule schedule, double end) {
  std::vector<double> times;
  for (double now = 0.25; now <= end; now += 0.25) {
    if (!schedule.due(now)) continue;
    times.push_back(now);
    schedule.saved(now);
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
  schedule.saved(103.0);
  EXPECT_FALSE(schedule.due(103.5));
  EXPECT_TRUE(schedule.due(104.0));
}

}  // namespace
}  // namespace ashlar::checkpoint_schedule_test

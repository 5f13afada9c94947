#include "apps/run/run_group.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "apps/results/folder/motion_verdict.hpp"
#include "solver/ranks/thread_ranks.hpp"

namespace ashlar::run_group_test {
namespace {

TEST(RunGroup, AProcessAloneDecidesForItself) {
  const RunGroup group;
  EXPECT_FALSE(group.shared());
  EXPECT_TRUE(group.first());
  for (const bool own : {true, false}) {
    EXPECT_EQ(group.any(own), own);
    EXPECT_EQ(group.as_first(own), own);
  }
  EXPECT_EQ(group.values(3), std::vector<int>{3});
  EXPECT_EQ(group.value_of_first(3), 3);
  EXPECT_EQ(group.result_of_first([] { return 4; }), 4);
  EXPECT_EQ(group.together(FallRecord{{{2, 0.5}}}).falls.size(), 1U);
  EXPECT_THROW(group.do_on_each([] { throw std::out_of_range("work"); }), std::out_of_range);
}

TEST(RunGroup, OneRankIsAlone) {
  SingleRank single;
  const RunRanks ranks{single};
  const RunGroup group(&ranks);
  EXPECT_FALSE(group.shared());
  EXPECT_TRUE(group.first());
  EXPECT_EQ(group.ranks(), &ranks);
  EXPECT_EQ(group.values(3), std::vector<int>{3});
}

TEST(RunGroup, SeveralProcessesDecideTogether) {
  constexpr int count = 3;
  std::atomic<int> calls = 0;
  run_on_threads(count, [&calls](Ranks& own) {
    const RunRanks ranks{own};
    const RunGroup group(&ranks);
    const int number = own.own();
    EXPECT_TRUE(group.shared());
    EXPECT_EQ(group.first(), number == 0);
    EXPECT_TRUE(group.any(number == 2)) << "of one";
    EXPECT_FALSE(group.any(false));
    EXPECT_TRUE(group.as_first(number == 0));
    EXPECT_FALSE(group.as_first(number > 0)) << "the others have no say";
    EXPECT_EQ(group.values(10 * number), (std::vector<int>{0, 10, 20}));
    EXPECT_EQ(group.value_of_first(number + 7), 7);
    const FallRecord falls = group.together(FallRecord{{{number, 1.0 - 0.1 * number}}});
    ASSERT_EQ(falls.falls.size(), 3U);
    EXPECT_EQ(falls.falls.front().block, 2) << "the earliest";
    EXPECT_EQ(group.result_of_first([&calls] { return ++calls; }), 1);
  });
  EXPECT_EQ(calls, 1);
}

TEST(RunGroup, WorkThatThrowsOnOneProcessThrowsOnAll) {
  std::atomic<int> thrown = 0;
  run_on_threads(2, [&thrown](Ranks& own) {
    const RunRanks ranks{own};
    const RunGroup group(&ranks);
    try {
      group.do_on_each([&own] {
        if (own.own() == 1) throw std::runtime_error("full");
      });
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "full");
      ++thrown;
    }
  });
  EXPECT_EQ(thrown, 2);
}

}  // namespace
}  // namespace ashlar::run_group_test

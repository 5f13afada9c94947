#include "solver/contact/pair_history.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace ashlar::pair_history_test {
namespace {

/// Memory of one point, the step's deepest and the bulge as given, m.
ContactMemory memory(double deepest, double bulge, int face = 0) {
  return {{{Vector3::Zero(), Vector3::Zero(), face, 0, Vector3::UnitZ(), 1.0, {}}}, {}, deepest, {}, bulge};
}

TEST(PairHistory, OfAPairThatIsNotKnownIsEmpty) {
  PairHistories histories;
  histories[{0, 2}].work = 3.0;
  EXPECT_EQ(history_of(histories, {0, 2}).work, 3.0);
  EXPECT_EQ(history_of(histories, {0, 1}).work, 0.0);
  EXPECT_TRUE(history_of(histories, {0, 1}).memory.empty());
  EXPECT_EQ(histories.size(), 1U) << "asking makes no entry";
}

TEST(PairHistory, IsSearchedAsDeepAsContactsOrTheAuditSay) {
  PairHistory pair;
  EXPECT_EQ(pair.depth_to_search(), 0.0);
  pair.memory = memory(0.25, 0.5);
  EXPECT_EQ(pair.depth_to_search(), 0.75);
  pair.depth = 0.5;
  EXPECT_EQ(pair.depth_to_search(), 0.75);
  pair.depth = 2.0;
  EXPECT_EQ(pair.depth_to_search(), 2.0);
}

TEST(PairHistory, OnlyWhatIsEmptyIsDropped) {
  PairHistories histories;
  histories[{0, 1}];
  histories[{0, 2}].work = 1.0;
  histories[{0, 3}].clearance = Clearance{1.0, 0.0};
  histories[{0, 4}].entrance = EntranceName{};
  histories[{0, 5}].spent = 1.0;
  histories[{0, 6}].depth = 1.0;
  histories[{0, 7}].memory = memory(0.0, 0.0);
  drop_empty(histories);
  EXPECT_EQ(histories.size(), 6U);
  EXPECT_FALSE(histories.contains({0, 1}));
}

TEST(PairHistory, ValuesThatCannotBeAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [](const PairKey& key, const PairHistory& pair) {
    EXPECT_THROW(validate({{key, pair}}, 3), std::logic_error);
  };
  PairHistory good;
  good.memory = memory(0.5, 0.0);
  good.spent = 1.0;
  EXPECT_NO_THROW(validate({{{0, 2}, good}}, 3));
  refuses({1, 0}, good);
  refuses({1, 1}, good);
  refuses({0, 3}, good);
  refuses({-1, 0}, good);
  PairHistory bad = good;
  bad.spent = -1.0;
  refuses({0, 1}, bad);
  bad = good;
  bad.depth = nan;
  refuses({0, 1}, bad);
  bad = good;
  bad.work = std::numeric_limits<double>::infinity();
  refuses({0, 1}, bad);
  bad = good;
  bad.memory = memory(0.5, 0.0, -1);
  refuses({0, 1}, bad);
  bad = good;
  bad.clearance = Clearance{nan, 0.0};
  refuses({0, 1}, bad);
}

}  // namespace
}  // namespace ashlar::pair_history_test

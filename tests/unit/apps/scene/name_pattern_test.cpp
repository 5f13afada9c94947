#include "apps/scene/name_pattern.hpp"

#include <gtest/gtest.h>

namespace ashlar::test {
namespace {

TEST(NamePattern, KnowsTheGlobsOfTheShell) {
  EXPECT_TRUE(pattern_matches("A", "A"));
  EXPECT_FALSE(pattern_matches("A", "a"));
  EXPECT_FALSE(pattern_matches("A", "AB"));
  EXPECT_TRUE(pattern_matches("wall*", "wall"));
  EXPECT_TRUE(pattern_matches("wall*", "wall/left"));
  EXPECT_TRUE(pattern_matches("row?", "row1"));
  EXPECT_FALSE(pattern_matches("row?", "row12"));
  EXPECT_TRUE(pattern_matches("row[1-3]", "row2"));
  EXPECT_FALSE(pattern_matches("row[1-3]", "row4"));
}

TEST(NamePattern, PatternOfANameMatchesNoOther) {
  EXPECT_EQ(pattern_of("rock.1"), "rock.1");
  for (const std::string name : {"a*", "a?", "[ab]", "a\\"})
    EXPECT_TRUE(pattern_matches(pattern_of(name), name));
  EXPECT_FALSE(pattern_matches(pattern_of("a*"), "ab"));
  EXPECT_FALSE(pattern_matches(pattern_of("[ab]"), "a"));
}

TEST(NamePattern, MatchesPairsInEitherOrder) {
  EXPECT_TRUE(pattern_matches_pair({"A", "B*"}, "A", "B2"));
  EXPECT_TRUE(pattern_matches_pair({"A", "B*"}, "B2", "A"));
  EXPECT_FALSE(pattern_matches_pair({"A", "B*"}, "B1", "B2"));
}

}  // namespace
}  // namespace ashlar::test

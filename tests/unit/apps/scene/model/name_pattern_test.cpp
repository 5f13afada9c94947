#include "apps/scene/model/name_pattern.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <string>

namespace ashlar::test::name_pattern_test {
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

TEST(NamePattern, CountsCodePoints) {
  EXPECT_TRUE(pattern_matches("?", "é"));
  EXPECT_TRUE(pattern_matches("?", "\xF0\x9F\xA7\xB1"));  // a brick, four bytes
  EXPECT_FALSE(pattern_matches("??", "é"));
  EXPECT_TRUE(pattern_matches("[é]", "é"));
  EXPECT_TRUE(pattern_matches("[à-ï]?", "éa"));
  EXPECT_FALSE(pattern_matches("[à-ï]", "ð"));
  EXPECT_TRUE(pattern_matches("*石?", "石石1"));
  EXPECT_FALSE(pattern_matches("[!é]", "é"));
}

TEST(NamePattern, BytesOfNoCodePointAreCharacters) {
  // A continuation alone, an overlong slash, half a surrogate pair, a lead byte without continuation, beyond the last plane.
  EXPECT_TRUE(pattern_matches("a?b",
                              "a\x80"
                              "b"));
  EXPECT_TRUE(pattern_matches("??", "\xC0\xAF"));
  EXPECT_TRUE(pattern_matches("???", "\xED\xA0\x80"));
  EXPECT_TRUE(pattern_matches("?", "\xE9"));
  EXPECT_TRUE(pattern_matches("????", "\xF4\x90\x80\x80"));
  EXPECT_TRUE(pattern_matches("\xE9*", "\xE9t"));
  EXPECT_FALSE(pattern_matches("\xE9", "é"));
}

TEST(NamePattern, KnowsSets) {
  EXPECT_TRUE(pattern_matches("[]a]", "]"));
  EXPECT_TRUE(pattern_matches("[!]a]", "b"));
  EXPECT_FALSE(pattern_matches("[^]a]", "]"));
  EXPECT_TRUE(pattern_matches("[a-]", "-"));
  EXPECT_TRUE(pattern_matches("[-a]", "-"));
  EXPECT_TRUE(pattern_matches("[\\]]", "]"));
  EXPECT_FALSE(pattern_matches("[\\]]", "\\"));
  EXPECT_FALSE(pattern_matches("[c-a]", "b"));
  EXPECT_TRUE(pattern_matches("[[:digit:]x][[:upper:]]", "7Q"));
  EXPECT_FALSE(pattern_matches("[[:alpha:]]", "é"));  // of ASCII only, in every locale
  EXPECT_FALSE(pattern_matches("[[:none:]]", "n"));
  EXPECT_TRUE(pattern_matches("[ab", "[ab"));  // no end: no set
  EXPECT_FALSE(pattern_matches("a\\", "a\\"));
}

TEST(NamePattern, ManyStarsCostAProductAtMost) {
  std::string pattern;
  for (int k = 0; k < 200; ++k) pattern += "*a";
  EXPECT_FALSE(pattern_matches(pattern + "b", std::string(2000, 'a')));
  EXPECT_TRUE(pattern_matches(pattern, std::string(2000, 'a')));
}

TEST(NamePattern, SaysTheSameInEveryLocale) {
  const std::string before = std::setlocale(LC_CTYPE, nullptr);
  const bool changed = std::setlocale(LC_CTYPE, "C.UTF-8") != nullptr;
  const bool one_letter = pattern_matches("?", "é");
  std::setlocale(LC_CTYPE, before.c_str());
  EXPECT_TRUE(changed);
  EXPECT_TRUE(one_letter);
  EXPECT_TRUE(pattern_matches("?", "é"));
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
}  // namespace ashlar::test::name_pattern_test

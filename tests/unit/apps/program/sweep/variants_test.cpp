#include "apps/program/sweep/variants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace ashlar::variants_test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

TEST(Variants, ValuesAreWhatStandsBetweenCommas) {
  EXPECT_THAT(parse_varied_key("a.b=1, 2e-3,-4").values, ElementsAre("1", "2e-3", "-4"));
  EXPECT_EQ(parse_varied_key(" a.b = 1").key, "a.b");
  EXPECT_THAT(parse_varied_key("g=[0,0,-9.81],[0,1,-9.81]").values,
              ElementsAre("[0,0,-9.81]", "[0,1,-9.81]"));
  EXPECT_THAT(parse_varied_key("r={axis=[0,0,1],angle=1},{axis=[1,0,0],angle=2}").values, SizeIs(2));
  EXPECT_THAT(parse_varied_key("t=\"a, b\",'c'").values, ElementsAre("\"a, b\"", "'c'"));
  EXPECT_THAT(parse_varied_key("h==2*w,=max(1,2)").values, ElementsAre("=2*w", "=max(1,2)"));
  for (const char* bad : {"", "a", "=1", "a=", "a=1,,2", "a=1,", "a=[1,2", "a=1]"})
    EXPECT_THROW((void)parse_varied_key(bad), std::invalid_argument) << bad;
}

TEST(Variants, AreAllCombinationsTheLastKeyFastest) {
  const std::vector<Variant> variants = variants_of({{"a", {"1", "2"}}, {"b", {"x", "y", "z"}}});
  ASSERT_THAT(variants, SizeIs(6));
  EXPECT_THAT(variants[0].values, ElementsAre("1", "x"));
  EXPECT_THAT(variants[1].values, ElementsAre("1", "y"));
  EXPECT_THAT(variants[3].values, ElementsAre("2", "x"));
  EXPECT_EQ(variants[3].folder, "a=2,b=x");
}

TEST(Variants, FoldersAreFileNamesAndDiffer) {
  const std::string length(400, 'x');
  const std::vector<Variant> variants =
      variants_of({{"file", {"a/b", "a b", "a_b", "../..", "\u00e4", length + "1", length + "2", "."}}});
  std::set<std::string> folders;
  for (const Variant& variant : variants) {
    EXPECT_EQ(variant.folder.find_first_of("/ \n"), std::string::npos) << variant.folder;
    EXPECT_LE(variant.folder.size(), 200U);
    folders.insert(variant.folder);
  }
  EXPECT_THAT(folders, SizeIs(variants.size()));
  // Independent of other keys varied in the same call, so that values can be added.
  EXPECT_EQ(variants_of({{"file", {"a b"}}})[0].folder, variants[1].folder);
}

TEST(Variants, SamplesAreTheSameForEachListedValue) {
  const std::vector<VariedKey> keys = {parse_varied_key("phi=normal(30, 2)"), parse_varied_key("dip=20,25"),
                                       parse_varied_key("c=uniform(0, 1e4)")};
  ASSERT_TRUE(keys[0].drawn && keys[2].drawn && !keys[1].drawn);
  const std::vector<Variant> variants = variants_of(keys, {5, 7});
  ASSERT_THAT(variants, SizeIs(10));
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(variants[k].values[1], "20");
    EXPECT_EQ(variants[k + 5].values[1], "25");
    EXPECT_EQ(variants[k].values[0], variants[k + 5].values[0]);
    EXPECT_EQ(variants[k].values[2], variants[k + 5].values[2]);
  }
  // More samples begin with the same ones, another seed has others.
  const std::vector<Variant> more = variants_of(keys, {8, 7});
  EXPECT_EQ(more[4], variants[4]);
  EXPECT_NE(variants_of(keys, {5, 8})[0].values[0], variants[0].values[0]);
}

TEST(Variants, SamplesNeedANumberAndSomethingToDraw) {
  EXPECT_THROW((void)variants_of({parse_varied_key("phi=normal(30, 2)")}), std::invalid_argument);
  EXPECT_THROW((void)variants_of({{"a", {"1", "2"}}}, {5, 1}), std::invalid_argument);
  EXPECT_THROW((void)variants_of({parse_varied_key("phi=normal(30, 2)")}, {100'001, 1}),
               std::invalid_argument);
  EXPECT_THROW((void)variants_of({parse_varied_key("phi=normal(30, 2)"), {"a", {"1", "2"}}}, {60'000, 1}),
               std::invalid_argument);
}

TEST(Variants, WhatComesTwiceIsRefused) {
  EXPECT_THROW((void)variants_of({{"a", {"1"}}, {"a", {"2"}}}), std::invalid_argument);
  EXPECT_THROW((void)variants_of({{"a", {"1", "1"}}}), std::invalid_argument);
  std::vector<std::string> many;
  for (int k = 0; k < 1000; ++k) many.push_back(std::to_string(k));
  EXPECT_THROW((void)variants_of({{"a", many}, {"b", many}}), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::variants_test

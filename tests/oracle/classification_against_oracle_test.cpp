// The classifier against the exact answers and against itself on variants. Fixed seeds; contact_variants runs
// any number of variants from any seed.
#include <gtest/gtest.h>

#include <cfenv>
#include <iostream>
#include <map>

#include "oracle/contact_comparison.hpp"
#include "oracle/degenerate_pairs.hpp"

namespace ashlar::oracle::classification_against_oracle_test {
namespace {

// So that a broken classifier does not print fifty thousand pairs.
constexpr int kMostReported = 10;

void report(const DegeneratePair& pair, const Differences& differences, int failures) {
  if (failures > kMostReported) return;
  std::string text = pair.family + "\n" + to_json(pair.p, pair.q);
  for (const std::string& difference : differences) text += "\n  " + difference;
  ADD_FAILURE() << text;
}

TEST(Classification, IsTheOraclesForFiftyThousandPairs) {
  constexpr int kPairs = 50000;
  DegeneratePairs pairs(20240601);
  int failures = 0;
  for (int i = 0; i < kPairs; ++i) {
    const DegeneratePair pair = pairs.next();
    const Differences differences = compare_with_oracle(pair.p, pair.q);
    if (!differences.empty()) report(pair, differences, ++failures);
  }
  EXPECT_EQ(failures, 0) << "of " << kPairs;
}

TEST(Classification, StaysUnderEveryRoundingMode) {
  constexpr int kPairs = 10000;
  DegeneratePairs pairs(20240604);
  int failures = 0;
  for (int i = 0; i < kPairs; ++i) {
    const DegeneratePair pair = pairs.next();
    const Variant same{pair.p, pair.q, false, {}};
    const ConvexContact original = classify(to_convex_shape(pair.p), to_convex_shape(pair.q));
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      ASSERT_EQ(std::fesetround(mode), 0);
      const ConvexContact answer = classify(to_convex_shape(pair.p), to_convex_shape(pair.q));
      ASSERT_EQ(std::fesetround(FE_TONEAREST), 0);
      const Differences differences =
          compare_with_variant(original, answer, same, pair.p.triangles.size() == 1);
      if (!differences.empty()) report(pair, differences, ++failures);
    }
  }
  EXPECT_EQ(failures, 0);
}

TEST(Classification, StaysForAMillionVariants) {
  constexpr int kPairs = 50000;
  constexpr int kVariantsPerPair = 20;
  DegeneratePairs pairs(20240602);
  Random random(20240603);
  std::map<std::string, int> types;
  int failures = 0;
  for (int i = 0; i < kPairs; ++i) {
    const DegeneratePair pair = pairs.next();
    const Variants variants(pair.p, pair.q);
    const ConvexContact original = classify(to_convex_shape(pair.p), to_convex_shape(pair.q));
    ++types[std::string(to_string(original.type()))];
    for (int j = 0; j < kVariantsPerPair; ++j) {
      const Variant variant = variants.random(random);
      const ConvexContact answer = classify(to_convex_shape(variant.p), to_convex_shape(variant.q));
      const Differences differences =
          compare_with_variant(original, answer, variant, pair.p.triangles.size() == 1);
      if (differences.empty()) continue;
      report(pair, differences, ++failures);
      report({variant.p, variant.q, "its variant"}, {}, failures);
    }
  }
  EXPECT_EQ(failures, 0) << "of " << kPairs * kVariantsPerPair;
  for (const auto& [type, count] : types) std::cout << type << ": " << 100.0 * count / kPairs << " %\n";
}

}  // namespace
}  // namespace ashlar::oracle::classification_against_oracle_test

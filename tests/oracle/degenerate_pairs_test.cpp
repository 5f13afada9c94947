// The supply of degenerate pairs: valid, reproducible, and with every answer common enough to be tested.
#include "oracle/degenerate_pairs.hpp"

#include <gtest/gtest.h>

#include <map>

#include "oracle/exact_oracle.hpp"

namespace ashlar::oracle::degenerate_pairs_test {
namespace {

TEST(DegeneratePairs, EachOfTheSevenAnswersIsFiveToThirtyPercent) {
  constexpr int kPairsOfAKind = 10000;
  DegeneratePairs pairs(1);
  std::map<bool, std::map<std::string, int>> counts;
  for (int i = 0; i < 2 * kPairsOfAKind; ++i) {
    const DegeneratePair pair = pairs.next();
    const bool solids = pair.p.triangles.size() > 1;
    ++counts[solids][type_name(classify_exactly(pair.p, pair.q).contact)];
  }
  for (const bool solids : {false, true}) {
    EXPECT_EQ(counts[solids].size(), 7U);
    for (const auto& [type, count] : counts[solids]) {
      SCOPED_TRACE(type + (solids ? " of solids" : " of triangles"));
      EXPECT_GE(count, 0.05 * kPairsOfAKind);
      EXPECT_LE(count, 0.30 * kPairsOfAKind);
    }
  }
}

TEST(DegeneratePairs, TouchAndAlmostTouch) {
  DegeneratePairs pairs(2);
  int touching = 0;
  int almost = 0;
  int barely_crossing = 0;
  const mpq_class tiny(mpz_class(1), mpz_class(1) << 70);
  for (int i = 0; i < 5000; ++i) {
    const DegeneratePair pair = pairs.next();
    const ExactAnswer answer = classify_exactly(pair.p, pair.q);
    touching += answer.contact.intersecting && !answer.contact.crossing ? 1 : 0;
    almost += !answer.contact.intersecting && answer.contact.squared_distance < tiny ? 1 : 0;
    barely_crossing +=
        answer.contact.crossing && answer.squared_depth > 0 && answer.squared_depth < tiny ? 1 : 0;
  }
  EXPECT_GT(touching, 1000);
  EXPECT_GT(almost, 200);
  EXPECT_GT(barely_crossing, 50);
}

TEST(DegeneratePairs, SameSeedSamePairs) {
  DegeneratePairs first(3);
  DegeneratePairs second(3);
  DegeneratePairs other(4);
  bool differs = false;
  for (int i = 0; i < 100; ++i) {
    const DegeneratePair pair = first.next();
    const DegeneratePair again = second.next();
    EXPECT_EQ(pair.p.points, again.p.points);
    EXPECT_EQ(pair.q.points, again.q.points);
    EXPECT_EQ(pair.p.triangles, again.p.triangles);
    EXPECT_EQ(pair.family, again.family);
    differs = differs || pair.p.points != other.next().p.points;
  }
  EXPECT_TRUE(differs);
}

}  // namespace
}  // namespace ashlar::oracle::degenerate_pairs_test

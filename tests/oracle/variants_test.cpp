// Variants checked with the oracle: each is the same pair, so the exact answer is the same one, carried
// along.
#include "oracle/variants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "oracle/degenerate_pairs.hpp"
#include "oracle/exact_oracle.hpp"

namespace ashlar::oracle::variants_test {
namespace {

mpq_class power_of_two(int exponent) {
  const mpz_class power = mpz_class(1) << static_cast<unsigned long>(std::abs(exponent));
  return exponent >= 0 ? mpq_class(power) : mpq_class(mpz_class(1), power);
}

RationalVector carried(const Similarity& similarity, const RationalVector& x) {
  RationalVector result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = (similarity.sign[k] * x[static_cast<std::size_t>(similarity.axis[k])] +
                 mpq_class(similarity.offset[k])) *
                power_of_two(similarity.scale);
  }
  return result;
}

/// Place on P and on Q and the two carrier dimensions of every region point.
using Region = std::set<std::tuple<RationalVector, RationalVector, int, int>>;

Region region_of(const ExactContact& contact, const Similarity& similarity, bool swapped) {
  Region region;
  for (const RegionPoint& point : contact.region) {
    RationalVector p = carried(similarity, point.on_p);
    RationalVector q = carried(similarity, point.on_q);
    int p_dimension = point.p_dimension;
    int q_dimension = point.q_dimension;
    if (swapped) std::swap(p, q);
    if (swapped) std::swap(p_dimension, q_dimension);
    region.emplace(p, q, p_dimension, q_dimension);
  }
  return region;
}

TEST(Variants, HaveTheAnswerOfTheirPair) {
  DegeneratePairs pairs(5);
  Random random(6);
  for (int i = 0; i < 3000; ++i) {
    const DegeneratePair pair = pairs.next();
    const ExactAnswer original = classify_exactly(pair.p, pair.q);
    const Variants variants(pair.p, pair.q);
    for (int j = 0; j < 3; ++j) {
      const Variant variant = variants.random(random);
      const ExactAnswer answer = classify_exactly(variant.p, variant.q);
      ASSERT_EQ(type_name(answer.contact), type_name(original.contact)) << pair.family;
      const mpq_class square = power_of_two(2 * variant.similarity.scale);
      ASSERT_EQ(answer.contact.squared_distance, original.contact.squared_distance * square);
      ASSERT_EQ(answer.squared_depth, original.squared_depth * square);
      ASSERT_EQ(region_of(answer.contact, {}, false),
                region_of(original.contact, variant.similarity, variant.swapped));
      ASSERT_EQ(answer.minimal_translations.size(), original.minimal_translations.size());
    }
  }
}

TEST(Variants, ReachAllFortyEightSignedPermutations) {
  const DegeneratePair pair = DegeneratePairs(7).next();
  const Variants variants(pair.p, pair.q);
  Random random(8);
  std::set<std::pair<std::array<int, 3>, std::array<int, 3>>> seen;
  int reflections = 0;
  for (int i = 0; i < 2000; ++i) {
    const Similarity similarity = variants.random(random).similarity;
    if (seen.emplace(similarity.axis, similarity.sign).second && similarity.reflects()) ++reflections;
  }
  EXPECT_EQ(seen.size(), 48U);
  EXPECT_EQ(reflections, 24);
}

std::set<std::set<Point>> corners_of(const Shape& solid, const std::vector<std::vector<int>>& facets) {
  std::set<std::set<Point>> result;
  for (const auto& cycle : facets) {
    std::set<Point> corners;
    for (const int corner : cycle) corners.insert(solid.points[static_cast<std::size_t>(corner)]);
    result.insert(std::move(corners));
  }
  return result;
}

TEST(MeshedAnew, IsClosedAndHasTheSameFacets) {
  DegeneratePairs pairs(9);
  Random random(10);
  std::size_t most_points = 0;
  for (int i = 0; i < 1000; ++i) {
    const Shape solid = pairs.next().p;
    if (solid.triangles.size() == 1) continue;
    const auto facets = facet_cycles(solid);
    const Shape mesh = meshed_anew(solid, facets, random);
    most_points = std::max(most_points, mesh.points.size() - solid.points.size());
    std::map<std::pair<int, int>, int> half_edges;
    for (const auto& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) ++half_edges[{t[k], t[(k + 1) % 3]}];
    }
    for (const auto& [edge, count] : half_edges) {
      ASSERT_EQ(count, 1);
      ASSERT_TRUE(half_edges.contains({edge.second, edge.first}));
    }
    ASSERT_EQ(corners_of(solid, facets), corners_of(mesh, facet_cycles(mesh)));
  }
  EXPECT_GT(most_points, 5U);
}

}  // namespace
}  // namespace ashlar::oracle::variants_test

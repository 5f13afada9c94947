#include "apps/scene/expand/joint_planes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/cutting/cut_error.hpp"

namespace ashlar::joint_planes_test {
namespace {

SceneCut bedding() {
  SceneCut cut;
  cut.dip = 90;
  cut.dip_direction = 90;
  cut.spacing = 0.1;
  return cut;
}

TEST(JointPlanes, RegularOnesStandAtMultiples) {
  const std::vector<JointPlane> planes = joint_planes(bedding(), {-0.25, 0.31});
  ASSERT_EQ(planes.size(), 6U);
  for (int k = 0; k < 6; ++k) {
    const JointPlane& plane = planes[static_cast<std::size_t>(k)];
    EXPECT_EQ(plane.number, k - 2);
    EXPECT_EQ(plane.plane.normal, Vector3::UnitX());
    EXPECT_EQ(plane.plane.offset, 0.1 * (k - 2)) << "no error adds up";
  }
  EXPECT_EQ(estimate_planes(bedding(), {-0.25, 0.31}), 6.0);
  EXPECT_EQ(estimate_planes(bedding(), {0.12, 0.18}), 0.0);
}

TEST(JointPlanes, NumberAndMissingSpacingLimitThem) {
  SceneCut cut = bedding();
  cut.number = 1;
  EXPECT_EQ(joint_planes(cut, {-9, 9}).size(), 3U);
  cut.number.reset();
  cut.spacing.reset();
  EXPECT_EQ(joint_planes(cut, {-9, 9}).size(), 1U);
  EXPECT_TRUE(joint_planes(cut, {1, 9}).empty());
  EXPECT_EQ(estimate_planes(cut, {1, 9}), 0.0);
  EXPECT_EQ(estimate_planes(cut, {-1, 9}), 1.0);
}

TEST(JointPlanes, AreCountedInAllRanges) {
  SceneCut cut = bedding();
  const std::vector<PlaneRange> ranges = {{-0.25, 0.31}, {0.12, 0.18}, {0.2, 0.9}};
  const JointHeights regular(cut, ranges, 13);
  EXPECT_EQ(regular.count(), 6 + 0 + 8);
  EXPECT_TRUE(regular.too_many());
  EXPECT_FALSE(JointHeights(cut, ranges, 14).too_many());
  cut.deviation = 0.02;
  const JointHeights drawn(cut, ranges, 100);
  EXPECT_FALSE(drawn.too_many());
  double count = 0.0;
  for (const PlaneRange& range : ranges) {
    const std::vector<JointHeight> here = drawn.in(range);
    const std::vector<JointHeight> alone = JointHeights(cut, {range}, 100).in(range);
    ASSERT_EQ(here.size(), alone.size());
    for (std::size_t k = 0; k < here.size(); ++k) {
      EXPECT_EQ(here[k].number, alone[k].number);
      EXPECT_EQ(here[k].height, alone[k].height);
      EXPECT_TRUE(k == 0 || here[k - 1].height < here[k].height);
    }
    count += static_cast<double>(here.size());
  }
  EXPECT_EQ(drawn.count(), count);
  EXPECT_TRUE(JointHeights(cut, ranges, count - 1).too_many());
  EXPECT_FALSE(JointHeights(cut, ranges, count).too_many());
}

TEST(JointPlanes, NoDrawGoesOnForEver) {
  SceneCut cut = bedding();
  cut.deviation = 0.02;
  EXPECT_TRUE(JointHeights(cut, {{0, 1e150}}, 1000).too_many());
  EXPECT_THROW(JointHeights(cut, {{1e149, 1e150}}, 1000), CutError);
}

// The planes do not depend on the region in which they are listed.
TEST(JointPlanes, RandomOnesAreTheSameInEveryRange) {
  SceneCut cut = bedding();
  cut.deviation = 0.05;
  cut.law = SceneCut::Spacing::lognormal;
  cut.fisher = 50;
  const std::vector<JointPlane> all = joint_planes(cut, {-5, 5}), few = joint_planes(cut, {2, 3});
  ASSERT_FALSE(few.empty());
  for (const JointPlane& plane : few) {
    bool found = false;
    for (const JointPlane& other : all)
      found = found || (other.number == plane.number && other.plane.normal == plane.plane.normal &&
                        other.plane.point == plane.plane.point);
    EXPECT_TRUE(found) << plane.number;
  }
  cut.seed = 2;
  EXPECT_NE(joint_planes(cut, {2, 3}).front().plane.normal, few.front().plane.normal);
}

// The mean of n draws has the standard error deviation over sqrt(n): five of these are allowed.
TEST(JointPlanes, SpacingsHaveTheirMeanAndDeviation) {
  constexpr int draws = 100000;
  for (const SceneCut::Spacing law : {SceneCut::Spacing::normal, SceneCut::Spacing::lognormal,
                                      SceneCut::Spacing::uniform, SceneCut::Spacing::exponential}) {
    SceneCut cut = bedding();
    cut.spacing = 2.0;
    cut.law = law;
    // Far enough from zero that normal draws are hardly ever drawn again.
    cut.deviation = law == SceneCut::Spacing::exponential ? 2.0 : 0.4;
    std::mt19937_64 random = random_stream(1, RandomStream::spacing_above);
    double sum = 0.0, squares = 0.0;
    for (int k = 0; k < draws; ++k) {
      const double spacing = random_spacing(cut, random);
      ASSERT_GT(spacing, 0.0);
      sum += spacing;
      squares += spacing * spacing;
    }
    const double mean = sum / draws, deviation = std::sqrt(squares / draws - mean * mean);
    EXPECT_NEAR(mean, 2.0, 5.0 * cut.deviation / std::sqrt(draws));
    EXPECT_NEAR(deviation, cut.deviation, 0.02 * cut.deviation);
  }
}

// The mean of cos t is coth k - 1/k.
TEST(JointPlanes, ScatterIsFishers) {
  constexpr int draws = 100000;
  const Vector3 mean = plane_normal(35, 120);
  for (const double k : {0.5, 5.0, 200.0}) {
    std::mt19937_64 random = random_stream(7, RandomStream::orientation);
    Vector3 sum = Vector3::Zero();
    for (int i = 0; i < draws; ++i) sum += scattered(mean, k, random);
    EXPECT_NEAR(sum.dot(mean) / draws, 1.0 / std::tanh(k) - 1.0 / k, 5.0 / std::sqrt(draws));
    EXPECT_NEAR((sum - sum.dot(mean) * mean).norm() / draws, 0.0, 5.0 / std::sqrt(draws));
  }
}

}  // namespace
}  // namespace ashlar::joint_planes_test

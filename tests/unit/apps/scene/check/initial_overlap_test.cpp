#include "apps/scene/check/initial_overlap.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "geometry/solid/shapes.hpp"
#include "support/sample_meshes.hpp"
#include "support/sample_solids.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::initial_overlap_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Polyhedron turned(const Polyhedron& solid, double degrees) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vector3> points;
  for (const Vector3& point : solid.mesh().points) points.emplace_back(turn * point);
  return solid.with_points(std::move(points));
}

Polyhedron box(const Vector3& low, const Vector3& high) {
  return Polyhedron(make_box(low, high));
}

// In any order, the depth of the pair.
double depth_of(const Polyhedron& a, const Polyhedron& b) {
  const double depth = overlap_depth(a, b).depth;
  EXPECT_NEAR(overlap_depth(b, a).depth, depth, 1e-14);
  return depth;
}

TEST(InitialOverlap, ConvexDepthIsTheLeastTranslation) {
  const Polyhedron cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(overlap_depth(cube, cube).exact);
  EXPECT_EQ(depth_of(cube, box({0.75, 0.5, 0.25}, {2, 2, 2})), 0.25);
  EXPECT_EQ(depth_of(cube, box({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5})), 0.5);  // inside: out through any side
  EXPECT_EQ(depth_of(cube, cube), 1.0);
}

TEST(InitialOverlap, TouchingAndApartAreNone) {
  const Polyhedron cube = box({0, 0, 0}, {1, 1, 1});
  const Polyhedron prism = test_support::l_shaped_prism();
  for (const Polyhedron& solid : {cube, prism}) {
    EXPECT_EQ(depth_of(solid, box({0, 0, 1}, {3, 3, 2})), 0.0);      // face on face
    EXPECT_EQ(depth_of(solid, box({-1, -1, 1}, {0, 0.5, 2})), 0.0);  // edge on edge
    EXPECT_EQ(depth_of(solid, box({-1, -1, -1}, {0, 0, 0})), 0.0);   // corner on corner
    EXPECT_EQ(depth_of(solid, box({0, 0, 1.001}, {1, 1, 2})), 0.0);
  }
  // In the corner of the L, touching two of its faces from inside their angle.
  EXPECT_EQ(depth_of(prism, box({1, 1, 0}, {2, 2, 1})), 0.0);
}

TEST(InitialOverlap, TouchingSolidsTurnedTogetherOverlapByRoundingOnly) {
  const Polyhedron cube = box({0, 0, 0}, {1, 1, 1});
  const Polyhedron prism = test_support::l_shaped_prism();
  for (const double angle : {10.0, 33.0, 71.0}) {
    for (const Polyhedron& solid : {cube, prism}) {
      const Polyhedron top = box({0.25, 0.25, 1}, {0.75, 0.75, 2});
      EXPECT_LT(depth_of(turned(solid, angle), turned(top, angle)), 1e-14);
    }
  }
}

TEST(InitialOverlap, SolidEnteringANonConvexOne) {
  const Polyhedron prism = test_support::l_shaped_prism();
  EXPECT_FALSE(overlap_depth(prism, prism).exact);
  // A corner of the cube is 0.125 below the top of the L.
  EXPECT_NEAR(depth_of(prism, box({0.25, 0.25, 0.875}, {0.75, 0.75, 2})), 0.125, 1e-15);
  // A bar through an arm of the L: the middles of its edges there are 0.25 from the top and bottom, and no
  // point of the arm is deeper than half its thickness.
  const double bar = depth_of(prism, box({-1, 1.25, 0.25}, {3, 1.75, 0.75}));
  EXPECT_GE(bar, 0.25);
  EXPECT_LE(bar, 0.5);
  // A small cube in it: a corner is 0.375 from the nearest sides.
  const double cube = depth_of(prism, box({0.375, 0.375, 0.375}, {0.625, 0.625, 0.625}));
  EXPECT_GE(cube, 0.375);
  EXPECT_LE(cube, 0.5);
}

TEST(InitialOverlap, SolidsWithoutAPointStrictlyInsideTheOtherAreFound) {
  const Polyhedron prism = test_support::l_shaped_prism();
  EXPECT_GT(depth_of(prism, prism), 0.1);
  // Every edge of the box lies in the surface of the frame or of itself.
  EXPECT_GT(depth_of(prism, box({0, 0, 0}, {1, 2, 1})), 0.1);
  // A plate in the middle of the opening of a frame touches it; one that fills the frame's ring does not.
  const Polyhedron frame(test_support::make_frame());
  EXPECT_EQ(depth_of(frame, box({1, 1, 0}, {2, 2, 1})), 0.0);
  EXPECT_GT(depth_of(frame, box({0, 0, 0}, {3, 3, 1})), 0.1);
}

TEST(InitialOverlap, IsReportedAtTheSecondBlockOfAPair) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(sample_with(16, "box = { min = [0, 0, 0.75], max = [1, 1, 1.75] }"),
                                  "s.toml", {}, diagnostics);
  check_initial_overlap(ExpandedScene(scene), {box({0, 0, 0.75}, {1, 1, 1.75}), box({0, 0, 0}, {4, 1, 1})},
                        diagnostics);
  EXPECT_THAT(
      printed(diagnostics),
      ElementsAre("s.toml:17:1: error: blocks \"A\" and \"B\" overlap by 0.25 m, allowed is touching or "
                  "1e-06 m; contact.allowed_overlap accepts more"));
}

TEST(InitialOverlap, RoundingOfPlacedBlocksIsAllowedAndNoMore) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(sample(), "s.toml", {}, diagnostics);
  const Polyhedron below = box({0, 0, 0}, {8, 8, 8});
  // The smaller block has a volume of 1 m^3.
  check_initial_overlap(ExpandedScene(scene), {box({0, 0, 8 - 0.9e-6}, {1, 1, 9 - 0.9e-6}), below},
                        diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  check_initial_overlap(ExpandedScene(scene), {box({0, 0, 8 - 1.1e-6}, {1, 1, 9 - 1.1e-6}), below},
                        diagnostics);
  EXPECT_EQ(printed(diagnostics).size(), 1U);
}

// A of 1 m^3 lies 1e-4 m deep in B, of 4 m^3.
std::vector<KnownOverlap> overlaps(double allowed, double depth, std::vector<std::string>& told) {
  Diagnostics diagnostics;
  Scene scene = parse_scene(sample(), "s.toml", {}, diagnostics);
  scene.contact.allowed_overlap = allowed;
  const std::vector<KnownOverlap> known = check_initial_overlap(
      ExpandedScene(scene), {box({0, 0, 1 - depth}, {1, 1, 2 - depth}), box({0, 0, 0}, {4, 1, 1})},
      diagnostics);
  warn_of_known_overlaps(ExpandedScene(scene), known, diagnostics);
  told = printed(diagnostics);
  return known;
}

TEST(InitialOverlap, OfUpToWhatIsAllowedIsAcceptedAndListed) {
  std::vector<std::string> told;
  const std::vector<KnownOverlap> known = overlaps(2e-4, 1e-4, told);
  ASSERT_EQ(known.size(), 1U);
  EXPECT_EQ(known[0].blocks, (std::array{0, 1}));
  EXPECT_NEAR(known[0].overlap.depth, 1e-4, 1e-15);
  EXPECT_TRUE(known[0].overlap.exact);
  EXPECT_FALSE(known[0].rounding);
  EXPECT_THAT(told,
              ElementsAre(HasSubstr(
                  "1 pair of blocks is placed in each other, by 0.0001 m at the deepest (\"A\" and \"B\")")));
  EXPECT_TRUE(overlaps(0.99e-4, 1e-4, told).empty());
  EXPECT_THAT(told, ElementsAre(HasSubstr(
                        "overlap by 0.0001 m, allowed is touching or 9.9e-05 m (contact.allowed_overlap)")));
}

TEST(InitialOverlap, OfRoundingStartsWithoutForceTooButIsNotWarnedOf) {
  std::vector<std::string> told;
  const std::vector<KnownOverlap> known = overlaps(2e-4, 0x1p-30, told);
  ASSERT_EQ(known.size(), 1U);
  EXPECT_TRUE(known[0].rounding);
  EXPECT_THAT(told, IsEmpty());
  // Without the key there is no known overlap, and springs start as usual.
  EXPECT_TRUE(overlaps(0.0, 0x1p-30, told).empty());
  EXPECT_THAT(told, IsEmpty());
}

TEST(InitialOverlap, OfATenthOfTheSmallerBlockIsRefusedWhateverIsAllowed) {
  std::vector<std::string> told;
  EXPECT_EQ(overlaps(0.5, 0.0999, told).size(), 1U);
  EXPECT_TRUE(overlaps(0.5, 0.1001, told).empty());
  EXPECT_THAT(told, ElementsAre(HasSubstr(
                        "overlap by 0.1 m, allowed is touching or 0.1 m, 0.1 of the smaller one's size")));
}

TEST(InitialOverlap, TwoFixedBlocksMayOverlap) {
  Diagnostics diagnostics;
  Scene scene = parse_scene(sample(), "s.toml", {}, diagnostics);
  const std::vector<std::optional<Polyhedron>> solids = {box({0, 0, 0}, {1, 1, 1}),
                                                         box({0, 0, 0}, {4, 1, 1})};
  scene.block[0].fixed = scene.block[1].fixed = true;
  check_initial_overlap(ExpandedScene(scene), solids, diagnostics);
  EXPECT_TRUE(diagnostics.good());
  scene.block[1].fixed = false;
  check_initial_overlap(ExpandedScene(scene), solids, diagnostics);
  EXPECT_FALSE(diagnostics.good());
}

}  // namespace
}  // namespace ashlar::test::initial_overlap_test

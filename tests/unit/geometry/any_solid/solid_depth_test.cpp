#include "geometry/any_solid/solid_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/boxes/box.hpp"
#include "geometry/solid/shapes.hpp"
#include "support/sample_meshes.hpp"
#include "support/sample_solids.hpp"

namespace ashlar::solid_depth_test {
namespace {

constexpr double resolution = 1e-6;

const SolidDepthFinder& cube() {
  static const SolidDepthFinder finder(Polyhedron(make_box({0, 0, 0}, {10, 10, 10})));
  return finder;
}

/// [0,2]x[0,1] and [0,1]x[1,2], z from 0 to 1: a reflex edge at x = y = 1.
const SolidDepthFinder& ell() {
  static const SolidDepthFinder finder(test_support::l_shaped_prism());
  return finder;
}

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

TEST(SolidDepth, APointInABoxIsAsDeepAsItsNearestFace) {
  ASSERT_TRUE(cube().convex());
  const auto depth = cube().of_point({3, 9, 5});
  ASSERT_TRUE(depth);
  EXPECT_DOUBLE_EQ(depth->depth, 1.0);
  EXPECT_EQ(depth->outward, Vector3(0, 1, 0));
}

TEST(SolidDepth, PointsOutsideAndOnTheSurfaceHaveNone) {
  for (const auto* finder : {&cube(), &ell()}) {
    EXPECT_FALSE(finder->of_point({-1, 0.5, 0.5}));
    EXPECT_FALSE(finder->of_point({0.5, 0, 0.5}));
    EXPECT_FALSE(finder->of_point({0, 0, 0}));
  }
  EXPECT_FALSE(ell().of_point({1.5, 1.5, 0.5}));
}

TEST(SolidDepth, BelowAReflexEdgeTheEdgeIsNearest) {
  ASSERT_FALSE(ell().convex());
  const auto depth = ell().of_point({0.9, 0.9, 0.5});
  ASSERT_TRUE(depth);
  EXPECT_NEAR(depth->depth, std::sqrt(0.02), 1e-15);
  EXPECT_NEAR((depth->outward - Vector3(1, 1, 0).normalized()).norm(), 0.0, 1e-14);
}

TEST(SolidDepth, TheWayOutOfWhatRoundingPutsOnAFaceIsItsNormal) {
  // Below y = x / 3 at x = 1: 1/3 as a double is lower by 2^-54 / 3, and its nearest point on the face differs from it in
  // no coordinate.
  const SolidDepthFinder finder(Polyhedron(test_support::make_prism(
      {{0, -1}, {1, -1}, {1.5, -0.5}, {2, -1}, {3, -1}, {3, 1}, {0, 0}},
      {{2, 3, 4}, {2, 4, 5}, {2, 5, 6}, {2, 6, 0}, {2, 0, 1}}, {{0, 1, 2, 3, 4, 5, 6}}, 1.0)));
  ASSERT_FALSE(finder.convex());
  const Vector3 x(1.0, 1.0 / 3.0, 0.5);
  const auto depth = finder.of_point(x);
  ASSERT_TRUE(depth);
  EXPECT_NEAR(depth->depth, 0x1p-54 / std::sqrt(10.0), 1e-30);
  EXPECT_NEAR((depth->outward - Vector3(-1, 3, 0).normalized()).norm(), 0.0, 1e-15);
}

TEST(SolidDepth, ASegmentThroughAnEdgeOfABoxIsDeepestWhereBothFacesAreAsNear) {
  // x = -1 + s and 10 - z = 3 - s are equal at s = 2.
  const auto depth = cube().of_segment({-1, 5, 7}, {9, 5, 17}, resolution);
  ASSERT_TRUE(depth);
  EXPECT_NEAR(depth->depth, 1.0, 1e-14);
  EXPECT_NEAR((depth->place - Vector3(1, 5, 9)).norm(), 0.0, 1e-13);
}

TEST(SolidDepth, ASegmentThatEndsInABoxIsDeepestThere) {
  const auto depth = cube().of_segment({5, 5, 12}, {5, 5, 7}, resolution);
  ASSERT_TRUE(depth);
  EXPECT_NEAR(depth->depth, 3.0, 1e-14);
}

TEST(SolidDepth, SegmentsBesideASolidHaveNone) {
  EXPECT_FALSE(cube().of_segment({-1, -1, 11}, {11, -1, 11}, resolution));
  EXPECT_FALSE(ell().of_segment({1.2, 1.2, 0.5}, {3, 3, 0.5}, resolution));
  double clearance = 0.0;
  EXPECT_FALSE(ell().of_segment({1.5, 1.4, 0.5}, {1.5, 1.6, 0.5}, resolution, 0.0, &clearance));
  EXPECT_GT(clearance, 0.0);
  EXPECT_LE(clearance, 0.4);
}

TEST(SolidDepth, NothingIsFoundThatIsNotDeeperThanIsKnown) {
  EXPECT_FALSE(cube().of_segment({5, 5, 12}, {5, 5, 7}, resolution, 3.5));
  EXPECT_FALSE(ell().of_segment({0.5, 0.25, 0.5}, {1.5, 0.25, 0.5}, resolution, 0.3));
}

TEST(SolidDepth, ASegmentAlongAnLIsAsDeepAsItsMiddleLine) {
  // At y = 0.75 the depth is min(x, 0.5, distance to the edge x = y = 1) on the way in from x = 0.
  const auto depth = ell().of_segment({-0.5, 0.75, 0.5}, {2.5, 0.75, 0.5}, resolution);
  ASSERT_TRUE(depth);
  EXPECT_NEAR(depth->depth, 0.5, resolution);
}

TEST(SolidDepth, NoPointOfASegmentIsDeeperThanTheAnswer) {
  std::mt19937_64 random(3);
  for (const auto& [name, solid] : test_support::sample_solids()) {
    const SolidDepthFinder finder(solid);
    const Box box = box_of(solid.mesh().points);
    const Vector3 size = box.high - box.low;
    const auto point = [&] {
      return Vector3(box.low +
                     size.cwiseProduct(Vector3(1.4 * uniform(random) - 0.2, 1.4 * uniform(random) - 0.2,
                                               1.4 * uniform(random) - 0.2)));
    };
    for (int trial = 0; trial < 20; ++trial) {
      const Vector3 start = point(), end = point();
      const double fine = 1e-4 * size.norm();
      const auto depth = finder.of_segment(start, end, fine);
      double sampled = 0.0;
      for (int k = 0; k <= 200; ++k) {
        if (const auto at = finder.of_point(start + (end - start) * k / 200.0))
          sampled = std::max(sampled, at->depth);
      }
      EXPECT_LE(sampled, (depth ? depth->depth : 0.0) + fine + 1e-12) << name;
      if (!depth) continue;
      EXPECT_NEAR(finder.of_point(depth->place)->depth, depth->depth, 1e-9 * size.norm()) << name;
    }
  }
}

TEST(SolidDepth, SegmentsAlongAFaceAreAsDeepAsTheyWereMovedIn) {
  // Between two points of each face, moved in or out by less and by more than the resolution. Only samples count
  // whose faces are wider than this motion.
  std::mt19937_64 random(5);
  int tried = 0;
  for (const auto& [name, solid] : test_support::sample_solids()) {
    const SolidDepthFinder finder(solid);
    if (finder.convex()) continue;
    const Box box = box_of(solid.mesh().points);
    const double size = (box.high - box.low).norm();
    const double fine = 1e-5 * size;
    for (const PolyhedronFace& face : solid.faces()) {
      const auto& [i, j, k] = solid.mesh().triangles[static_cast<std::size_t>(face.triangles.front())];
      const auto corner = [&points = solid.mesh().points](int index) {
        return points[static_cast<std::size_t>(index)];
      };
      const Vector3 middle = (corner(i) + corner(j) + corner(k)) / 3.0;
      const Vector3 start = 0.5 * (middle + corner(i));
      const Vector3 end = 0.5 * (middle + corner(j));
      for (const double share : {-100.0, -10.0, -0.1, 0.1, 10.0, 100.0}) {
        const Vector3 in = -share * fine * face.normal;
        const auto depth = finder.of_segment(start + in, end + in, fine);
        const auto expected = finder.of_point(0.5 * (start + end) + in);
        const double least = share > 0.0 && expected ? expected->depth : 0.0;
        EXPECT_GE((depth ? depth->depth : 0.0) + fine, least) << name << ' ' << share;
        if (share < 0.0) {
          EXPECT_FALSE(depth && depth->depth > fine && !expected) << name << ' ' << share;
        }
        ++tried;
      }
    }
  }
  EXPECT_GE(tried, 8 * 6);  // the L alone has 8 faces
}

TEST(SolidDepth, NothingIsInABallThatIsClear) {
  double clearance = -1.0;
  EXPECT_TRUE(ell().of_point({0.5, 0.5, 0.5}, &clearance));
  EXPECT_EQ(clearance, 0.0);
  EXPECT_FALSE(ell().of_point({1.5, 1.25, 0.5}, &clearance));
  EXPECT_NEAR(clearance, 0.25, 1e-15);
}

}  // namespace
}  // namespace ashlar::solid_depth_test

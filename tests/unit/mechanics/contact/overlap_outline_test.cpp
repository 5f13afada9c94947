#include "mechanics/contact/overlap_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/placed_bodies.hpp"
#include "support/sample_solids.hpp"

namespace ashlar::overlap_outline_test {
namespace {

using Body = test_support::PlacedBody;
using test_support::box;
using Polygon = std::vector<Eigen::Vector2d>;

TEST(OverlapOutline, CornersThatRoundingMakesAreLeftOut) {
  const Polygon outline =
      outline_of({{0, 0}, {0.5, -1e-13}, {1, 0}, {1, 1e-14}, {1, 1}, {0.3, 1}, {0, 1}}, 1e-10);
  const Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  ASSERT_EQ(outline.size(), square.size());
  for (std::size_t k = 0; k < square.size(); ++k) EXPECT_LT((outline[k] - square[k]).norm(), 1e-12) << k;
}

TEST(OverlapOutline, CornersThatTurnStay) {
  // The first sticks out by 1e-9, ten tolerances.
  const Polygon polygon = {{0.5, -1e-9}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  EXPECT_EQ(outline_of(polygon, 1e-10), polygon);
}

TEST(OverlapOutline, ASliverIsNothing) {
  EXPECT_TRUE(outline_of(Polygon{{0, 0}, {1, 0}, {1, 1e-13}, {0, 1e-13}}, 1e-10).empty());
  EXPECT_TRUE(outline_of(Polygon{{0, 0}, {1, 0}, {0.5, 1e-13}}, 1e-10).empty());
  EXPECT_TRUE(outline_of(Polygon{}, 1e-10).empty());
}

TEST(OverlapOutline, TheToleranceIsOfTheSmallerBodyAndOfCoordinates) {
  const Body small(box({0, 0, 0}, {0.3, 0.4, 1.2}));  // diagonal 1.3
  const Body large(box({-10, -10, -1}, {10, 10, 0}));
  EXPECT_NEAR(outline_tolerance(small.placed, large.placed), 1.3e-10, 1e-20);
  const Body far(box({1e6, 0, 0}, {1e6 + 1, 1, 1}));
  EXPECT_NEAR(outline_tolerance(far.placed, far.placed), 16.0 * 0x1p-52 * (1e6 + 1), 1e-22);
  EXPECT_EQ(coordinate_rounding(far.placed, far.placed), outline_tolerance(far.placed, far.placed));
}

struct Whole {
  std::size_t corners = 0;
  double area = 0.0;
};

Whole outline_between(const Body& a, const Body& b) {
  const PairContacts contacts = find_contacts(a.placed, b.placed, {0.01, 0.01, 0.1});
  Whole sum;
  for (const FaceOverlap& face : join_by_faces(a.placed, b.placed, contacts.overlaps)) {
    const FaceOutline outline =
        outline_of(face, contacts.overlaps, false, outline_tolerance(a.placed, b.placed));
    sum.corners += outline.corners.size();
    sum.area += outline.area;
  }
  return sum;
}

// The lower face of an L, area 3, comes in pieces. Its rim lies on that of the plate to the last bits.
TEST(OverlapOutline, PiecesHaveTheCornersOfTheWhole) {
  const Body ell(test_support::l_shaped_prism());
  for (const double off : {0.0, 0x1p-50, -0x1p-50}) {
    const Body plate(box({off, off, -1}, {2 - off, 2, 0}));
    const Whole whole = outline_between(ell, plate);
    EXPECT_EQ(whole.corners, 6U) << off;
    EXPECT_NEAR(whole.area, 3.0, 1e-13) << off;
  }
}

// An edge that crosses another one by rounding only yields spurious corners: these two squares are turned
// against each other by the last bit.
TEST(OverlapOutline, RimsOnEachOtherCrossNowhere) {
  const double off = 0x1p-50;
  const Body above(Polyhedron(make_convex_hull(std::vector<Vector3>{
      {0, 0, 0}, {1, off, 0}, {1, 1, 0}, {-off, 1, 0}, {0, 0, 1}, {1, off, 1}, {1, 1, 1}, {-off, 1, 1}})));
  const Body below(Polyhedron(make_convex_hull(std::vector<Vector3>{
      {0, off, -1}, {1, 0, -1}, {1, 1, -1}, {off, 1, -1}, {0, off, 0}, {1, 0, 0}, {1, 1, 0}, {off, 1, 0}})));
  const Whole whole = outline_between(above, below);
  EXPECT_EQ(whole.corners, 4U);
  EXPECT_NEAR(whole.area, 1.0, 1e-13);
}

/// A prism of height 1 over a quadrilateral, its top or its bottom in the plane z = 0.
Body prism(const Polygon& base, double low) {
  std::vector<Vector3> points;
  for (const double z : {low, low + 1.0})
    for (const Eigen::Vector2d& corner : base) points.emplace_back(corner.x(), corner.y(), z);
  return Body(Polyhedron(make_convex_hull(points)));
}

// Two squares turned against each other by a small angle about their middle cross near the middles of their
// sides: an octagon, but a stack that twists a little still stands on its four corners. Turned by more, all
// eight count.
TEST(OverlapOutline, SidesThatAlmostFitCrossNowhere) {
  const Body below = prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, -1.0);
  const auto turned = [](double t) {
    // Corners (+-1/2, +-1/2) turned by t: x - t y, y + t x, longer by 1 + t^2 / 2 only.
    const double p = 0.5 + 0.5 * t;
    const double m = 0.5 - 0.5 * t;
    return prism({{0.5 - m, 0.5 - p}, {0.5 + p, 0.5 - m}, {0.5 + m, 0.5 + p}, {0.5 - p, 0.5 + m}}, 0.0);
  };
  for (const double t : {0x1p-30, 0x1p-20, 0x1p-10})
    EXPECT_EQ(outline_between(turned(t), below).corners, 4U) << t;
  EXPECT_EQ(outline_between(turned(0.125), below).corners, 8U);
}

// Faces of bending blocks almost coincide: near a corner of both several sides cross, a piece keeps any of these
// corners, and each piece is projected along its own normal. The corner is a contact point nevertheless.
TEST(OverlapOutline, FacesThatBendAndAlmostFitKeepTheirCorners) {
  const Body below(box({0, 0, -1}, {1, 1, 0}), 0);
  const Body above(box({0, 0, 0}, {1, 1, 1}), 0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(-3e-4, 3e-4);
  std::uniform_real_distribution<double> across(0.0, 5e-3);
  const auto bent = [&](const Body& body, double side) {
    std::vector<Vector3> points = body.surface.points;
    for (Vector3& point : points) point += Vector3(along(random), along(random), side * across(random));
    return PlacedSurface(body.surface, points);
  };
  for (int scene = 0; scene < 200; ++scene) {
    const PlacedSurface a = bent(above, 1.0);
    const PlacedSurface b = bent(below, -1.0);
    const PairContacts contacts = find_contacts(a, b, {0.02, 0.01, 0.1});
    const std::vector<FaceOverlap> faces = join_by_faces(a, b, contacts.overlaps);
    ASSERT_EQ(faces.size(), 1U) << scene;
    const FaceOutline outline = outline_of(faces[0], contacts.overlaps, true, outline_tolerance(a, b));
    const auto has = [&](const Vector3& corner) {
      return std::any_of(outline.corners.begin(), outline.corners.end(), [&](const FaceOverlapPoint& point) {
        const CellOverlap& overlap = contacts.overlaps[static_cast<std::size_t>(point.overlap)];
        const Eigen::Vector2d& place = overlap.corners[static_cast<std::size_t>(point.corner)].place;
        const Vector3 lifted =
            overlap.frame.origin + place.x() * overlap.frame.e1 + place.y() * overlap.frame.e2;
        return (lifted - corner).head<2>().norm() < 2e-3;  // the blur, and how far corners are moved
      });
    };
    for (const Vector3& corner : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(1, 1, 0)})
      EXPECT_TRUE(has(corner)) << scene << ": " << corner.transpose();
  }
}

// A strip that is narrow as a whole keeps its corners.
TEST(OverlapOutline, ANarrowOverlapHasCornersToo) {
  const Body below(box({0, 0, -1}, {1, 1, 0}));
  for (const double width : {1e-3, 1e-5, 1e-8}) {
    const Body above(box({1.0 - width, 0, 0}, {2, 1, 1}));
    const Whole whole = outline_between(above, below);
    EXPECT_EQ(whole.corners, 4U) << width;
    EXPECT_NEAR(whole.area, width, 1e-15) << width;
  }
}

}  // namespace
}  // namespace ashlar::overlap_outline_test

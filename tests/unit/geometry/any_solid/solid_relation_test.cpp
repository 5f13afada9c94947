#include "geometry/any_solid/solid_relation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "geometry/convex/convex_contact.hpp"
#include "geometry/solid/shapes.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar::solid_relation_test {
namespace {

SolidRelation relate(const TriangleMesh& a, const TriangleMesh& b) {
  const Polyhedron solid_a(a), solid_b(b);
  return relate_solids(SolidFeatures(solid_a), SolidFeatures(solid_b));
}

void expect_relation(const TriangleMesh& a, const TriangleMesh& b, Relation relation, double squared) {
  for (const bool swapped : {false, true}) {
    const SolidRelation found = swapped ? relate(b, a) : relate(a, b);
    EXPECT_EQ(found.relation, relation) << (swapped ? "swapped" : "");
    EXPECT_EQ(found.squared_distance, squared) << (swapped ? "swapped" : "");
  }
}

// Hull of a few points of a small lattice: all kinds of contact are common.
TriangleMesh lattice_hull(std::mt19937_64& random) {
  for (;;) {
    std::vector<Vector3> points;
    const std::size_t count = 4 + random() % 5;
    while (points.size() < count)
      points.emplace_back(static_cast<double>(random() % 4), static_cast<double>(random() % 4),
                          static_cast<double>(random() % 4));
    try {
      return make_convex_hull(points);
    } catch (const std::invalid_argument&) {
      // coplanar: other points
    }
  }
}

TEST(SolidRelation, AgreesWithTheClassifierOfConvexSolids) {
  std::mt19937_64 random(20240607);
  std::array<int, 3> seen{};
  for (int i = 0; i < 1500; ++i) {
    const TriangleMesh a = lattice_hull(random);
    TriangleMesh b = lattice_hull(random);
    const Vector3 shift(static_cast<double>(random() % 4), static_cast<double>(random() % 3), 0.0);
    for (Vector3& p : b.points) p += shift;
    const ConvexContact expected = classify(ConvexShape::from_mesh(a), ConvexShape::from_mesh(b));
    const SolidRelation found = relate(a, b);
    ASSERT_EQ(found.relation, expected.relation) << i;
    ASSERT_EQ(found.squared_distance, expected.squared_distance) << i;
    ++seen.at(static_cast<std::size_t>(expected.relation));
  }
  for (const int count : seen) EXPECT_GT(count, 100);
}

TEST(SolidRelation, BlockInTheCornerOfAnL) {
  const TriangleMesh l = test_support::make_l_prism();
  expect_relation(l, make_box({1, 1, 0}, {2, 2, 1}), Relation::touching, 0.0);
  expect_relation(l, make_box({1, 1, 0.25}, {2, 2, 5}), Relation::touching, 0.0);
  expect_relation(l, make_box({1.25, 1.5, 0}, {2, 2, 1}), Relation::apart, 0.0625);
  const double inside = 1.0 - 0x1p-40;
  expect_relation(l, make_box({inside, 1, 0}, {2, 2, 1}), Relation::crossing, 0.0);
  expect_relation(l, make_box({1, inside, 0.25}, {2, 2, 0.5}), Relation::crossing, 0.0);
}

TEST(SolidRelation, PlugInTheHoleOfAFrame) {
  const TriangleMesh frame = test_support::make_frame();
  expect_relation(frame, make_box({1, 1, 0}, {2, 2, 1}), Relation::touching, 0.0);
  expect_relation(frame, make_box({1, 1, -1}, {2, 2, 2}), Relation::touching, 0.0);
  expect_relation(frame, make_box({1.25, 1.25, -1}, {1.75, 1.75, 2}), Relation::apart, 0.0625);
  expect_relation(frame, make_box({1, 1, 0}, {2, 2.25, 1}), Relation::crossing, 0.0);
  expect_relation(frame, make_box({0, 0, 1}, {3, 3, 2}), Relation::touching, 0.0);
}

TEST(SolidRelation, OneSolidInsideTheOther) {
  const TriangleMesh l = test_support::make_l_prism();
  expect_relation(l, make_box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}), Relation::crossing, 0.0);
  // Touching from inside: in a face, along edges, in all faces.
  expect_relation(l, make_box({0.25, 0.25, 0}, {0.75, 0.75, 0.5}), Relation::crossing, 0.0);
  expect_relation(l, make_box({0, 0, 0}, {0.5, 0.5, 0.5}), Relation::crossing, 0.0);
  expect_relation(l, make_box({0, 0, 0}, {1, 1, 1}), Relation::crossing, 0.0);
  expect_relation(l, l, Relation::crossing, 0.0);
  // From inside in a corner only: the tip is in the middle of the top of a wide block.
  const TriangleMesh block = make_box({-4, -4, -4}, {6, 6, 3});
  expect_relation(block, test_support::make_pyramid(), Relation::crossing, 0.0);
}

TEST(SolidRelation, TipOnAFaceIsTouching) {
  // The pyramid ends at (1, 1, 3), the middle of the lower side of the block, where diagonals may cross.
  for (const double reach : {1.0, 2.0, 3.0})
    expect_relation(make_box({1 - reach, 1 - reach, 3}, {1 + reach, 1 + reach, 4}),
                    test_support::make_pyramid(), Relation::touching, 0.0);
}

TEST(SolidRelation, RidgeInAValley) {
  // A valley along y with its floor line at (1, y, 1); a ridge, narrower or wider, whose edge is that line.
  const TriangleMesh valley = test_support::make_prism(
      {{0, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}, {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}}, {{0, 1, 2, 3, 4}}, 2.0);
  const auto ridge = [](double half_width) {
    return make_convex_hull(std::vector<Vector3>{{1, 1, 0.5},
                                                 {1, 1, 1.5},
                                                 {1 - half_width, 2, 0.5},
                                                 {1 - half_width, 2, 1.5},
                                                 {1 + half_width, 2, 0.5},
                                                 {1 + half_width, 2, 1.5}});
  };
  expect_relation(valley, ridge(0.5), Relation::touching, 0.0);
  expect_relation(valley, ridge(1.0), Relation::touching, 0.0);
  expect_relation(valley, ridge(1.0 + 0x1p-30), Relation::crossing, 0.0);
}

}  // namespace
}  // namespace ashlar::solid_relation_test

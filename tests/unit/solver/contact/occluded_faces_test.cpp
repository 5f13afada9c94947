#include "solver/contact/occluded_faces.hpp"

#include <gtest/gtest.h>

#include "support/placed_bodies.hpp"

namespace ashlar::occluded_faces_test {
namespace {

using test_support::box;
using Body = test_support::PlacedBody;

int face_towards(const Polyhedron& solid, const Vector3& direction) {
  for (std::size_t k = 0; k < solid.faces().size(); ++k)
    if (solid.faces()[k].normal.dot(direction) > 0.99) return static_cast<int>(k);
  return -1;
}

/// A low box beside a high one; they have x = 1, 0 < z < 1 in common, to a gap.
OccludedFaces between(const Body& low, const Body& high, double reach) {
  OccludedFaces sides;
  const PairContacts contacts = find_contacts(low.placed, high.placed, {reach, reach, 0.1});
  sides.add({4, 7}, contacts.overlaps, low.surface, high.surface, reach);
  return sides;
}

TEST(OccludedFaces, OnlyTheCommonPartOfASideIsHidden) {
  const Body low(box({0, 0, 0}, {1, 1, 1}));
  const Body high(box({1, 0, 0}, {2, 1, 2}));
  const OccludedFaces sides = between(low, high, 1e-3);
  const int side = face_towards(high.solid, -Vector3::UnitX());
  EXPECT_TRUE(sides.hides(7, side, 9, {1, 0.5, 0.5}));
  EXPECT_FALSE(sides.hides(7, side, 9, {1, 0.5, 1.5}));
  EXPECT_TRUE(sides.hides(4, face_towards(low.solid, Vector3::UnitX()), 9, {1, 0.5, 0.5}));
  EXPECT_FALSE(sides.hides(4, face_towards(low.solid, Vector3::UnitZ()), 9, {0.5, 0.5, 1}));
}

TEST(OccludedFaces, ABlockHidesNothingFromItself) {
  const Body low(box({0, 0, 0}, {1, 1, 1}));
  const Body high(box({1, 0, 0}, {2, 1, 2}));
  const OccludedFaces sides = between(low, high, 1e-3);
  EXPECT_FALSE(sides.hides(7, face_towards(high.solid, -Vector3::UnitX()), 4, {1, 0.5, 0.5}));
  EXPECT_FALSE(sides.of_pair({4, 7}).of_b(face_towards(high.solid, -Vector3::UnitX()), {1, 0.5, 0.5}));
  EXPECT_TRUE(sides.of_pair({7, 9}).of_a(face_towards(high.solid, -Vector3::UnitX()), {1, 0.5, 0.5}));
}

TEST(OccludedFaces, SidesFartherApartThanTheReachAreOpen) {
  const Body low(box({0, 0, 0}, {0.99, 1, 1}));
  const Body high(box({1, 0, 0}, {2, 1, 2}));
  EXPECT_TRUE(between(low, high, 1e-3).empty());
  EXPECT_FALSE(between(low, high, 0.02).empty());
}

}  // namespace
}  // namespace ashlar::occluded_faces_test

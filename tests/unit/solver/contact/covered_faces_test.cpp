#include "solver/contact/covered_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "support/placed_bodies.hpp"

namespace ashlar::covered_faces_test {
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

/// Touches of a corner of a block with another block's side, which is occluded, after turn_to_open_faces().
struct CornerAtSide {
  Body falling{box({0.49, 0.5, 2.001}, {0.99, 0.8, 2.5})};
  Body resting{box({1, 0, 0}, {2, 1, 2})};
  int side = face_towards(resting.solid, -Vector3::UnitX());

  [[nodiscard]] int cell_of(int face) const {
    const auto& cells = resting.surface.cells;
    const auto of_face = std::find_if(cells.begin(), cells.end(),
                                      [face](const SurfaceCell& cell) { return cell.face == face; });
    return static_cast<int>(of_face - cells.begin());
  }
  /// @param faces that the corner touches
  [[nodiscard]] std::vector<Touch> turned(const Vector3& motion, const std::vector<int>& faces) const {
    const Vector3 corner(0.99, 0.5, 2.001);
    const std::vector<Vector3>& points = falling.surface.points;
    const auto of_corner = std::find_if(points.begin(), points.end(),
                                        [&](const Vector3& point) { return (point - corner).norm() < 1e-9; });
    std::vector<Vector3> moved;
    for (const Vector3& point : points) moved.push_back(point + motion);
    const PlacedSurface end(falling.surface, moved);
    std::vector<Touch> touches;
    for (const int face : faces)
      touches.push_back({0.5, VertexContact{true, static_cast<int>(of_corner - points.begin()), 0,
                                            cell_of(face), 0.01, 1.0}});
    const OccludedPlaces hidden{[](int, const Vector3&) { return false; },
                                [this](int face, const Vector3&) { return face == side; }};
    turn_to_open_faces({&falling.placed, &end}, {&resting.placed, &resting.placed}, hidden, touches);
    return touches;
  }
};

TEST(OccludedFaces, ACornerBehindAnOccludedSideHasEnteredBelowTheFaceBesideIt) {
  const CornerAtSide corner;
  const int top = face_towards(corner.resting.solid, Vector3::UnitZ());
  const std::vector<Touch> touches = corner.turned({0.011, 0, -0.002}, {corner.side, top});
  ASSERT_EQ(touches.size(), 1U) << "it touches that face once";
  const VertexContact& contact = std::get<VertexContact>(touches[0].contact);
  EXPECT_EQ(contact.cell, corner.cell_of(top));
  EXPECT_NEAR(contact.gap, 0.001, 1e-12) << "at the start";
}

TEST(OccludedFaces, ACornerThatEndsOutsideDoesNotTouch) {
  const CornerAtSide corner;
  EXPECT_TRUE(corner.turned({0.011, 0, -0.0005}, {corner.side}).empty());
  const int flank = face_towards(corner.resting.solid, Vector3::UnitY());
  EXPECT_EQ(corner.turned({0.011, 0, -0.0005}, {flank}).size(), 1U) << "with an open face";
}

/// True if a second slab continues the surface, for a cube on both, behind the edge of the first one at x = 0.
/// @param fall of the second one's top over its length, m
bool continues(double second_start, double second_top, double cube_bottom, double fall = 0.0) {
  const Body first(box({-1, -1, -1}, {0, 1, 0}));
  std::vector<Vector3> corners;
  for (const double y : {-1.0, 1.0}) {
    corners.insert(corners.end(), {{second_start, y, -1}, {1, y, -1}, {1, y, second_top - fall}});
    corners.emplace_back(second_start, y, second_top);
  }
  const Body second(Polyhedron(make_convex_hull(corners)));
  const Body cube(box({-0.5, -0.5, cube_bottom}, {0.5, 0.5, 1}));
  const ContactLimits limits{0.01, 0.01, 0.1};
  const std::array found = {find_contacts(first.placed, cube.placed, limits),
                            find_contacts(second.placed, cube.placed, limits)};
  SurfaceContinuation covered(1e-3);
  covered.add({0, 2}, found[0].overlaps, first.placed, cube.placed);
  covered.add({1, 2}, found[1].overlaps, second.placed, cube.placed);
  EXPECT_FALSE(found[0].overlaps.empty());
  EXPECT_FALSE(found[1].overlaps.empty());
  const int bottom = cube.surface.cells[static_cast<std::size_t>(found[0].overlaps[0].cell_b)].face;
  const double near = std::max(0.0, cube_bottom) + 1e-9;
  const Vector3 right = Vector3::UnitX();
  // Where nothing but the first slab is.
  EXPECT_FALSE(covered.continues(2, 0, {true, bottom, Vector3(-0.4, 0, 0), -right, near}));
  // The second slab is not behind its own rim.
  EXPECT_FALSE(covered.continues(2, 1, {true, bottom, Vector3(0.4, 0, 0), right, near}));
  return covered.continues(2, 0, {true, bottom, Vector3(0, 0, 0), right, near});
}

TEST(SurfaceContinuation, ABlockOnTwoLiesOnOneSurface) {
  EXPECT_TRUE(continues(0.0, 0.0, 0.0));
  EXPECT_TRUE(continues(0.0, 0.0, 1e-4)) << "as near as the first";
  EXPECT_TRUE(continues(0.0, -1e-5, -2e-5)) << "lower, but touched";
  EXPECT_TRUE(continues(5e-4, 0.0, -1e-5)) << "a narrow joint";
}

TEST(SurfaceContinuation, RimsAreEndsWhereNothingIsBehindThem) {
  EXPECT_FALSE(continues(2e-3, 0.0, -1e-5)) << "a wide joint";
  EXPECT_FALSE(continues(0.0, -1e-4, -1e-5)) << "lower, not touched";
  EXPECT_FALSE(continues(0.0, -1e-4, 1e-5)) << "lower";
  EXPECT_FALSE(continues(0.0, 0.0, 0.0, 1e-3)) << "the other half of a roof";
}

}  // namespace
}  // namespace ashlar::covered_faces_test

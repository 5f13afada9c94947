#include "solver/contact/surface_continuation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "support/placed_bodies.hpp"

namespace ashlar::surface_continuation_test {
namespace {

/// True if a second slab continues the surface, for a cube on both, behind the edge of the first one at x = 0.
/// @param fall of the second one's top over its length, m
bool goes_on(double second_start, double second_top, double cube_bottom, double fall = 0.0) {
  const test_support::PlacedBody first(test_support::box({-1, -1, -1}, {0, 1, 0}));
  std::vector<Vector3> corners;
  for (const double y : {-1.0, 1.0}) {
    corners.insert(corners.end(), {{second_start, y, -1}, {1, y, -1}, {1, y, second_top - fall}});
    corners.emplace_back(second_start, y, second_top);
  }
  const test_support::PlacedBody second(Polyhedron(make_convex_hull(corners)));
  const test_support::PlacedBody cube(test_support::box({-0.5, -0.5, cube_bottom}, {0.5, 0.5, 1}));
  const std::array<const PlacedSurface*, 3> placed = {&first.placed, &second.placed, &cube.placed};
  const ContactLimits limits{0.01, 0.01, 0.1};
  std::vector<FoundContacts> found;
  for (const int slab : {0, 1})
    found.push_back({{slab, 2}, find_contacts(*placed[static_cast<std::size_t>(slab)], cube.placed, limits)});
  const SurfaceContinuation covered(
      found, [&](int block) -> const PlacedSurface& { return *placed[static_cast<std::size_t>(block)]; },
      1e-3);
  EXPECT_FALSE(found[0].contacts.overlaps.empty());
  EXPECT_FALSE(found[1].contacts.overlaps.empty());
  const int bottom = cube.surface.cells[static_cast<std::size_t>(found[0].contacts.overlaps[0].cell_b)].face;
  const double near = std::max(0.0, cube_bottom) + 1e-9;
  const Vector3 right = Vector3::UnitX();
  // Where nothing but the first slab is.
  EXPECT_FALSE(covered.goes_on(2, 0, {true, bottom, Vector3(-0.4, 0, 0), -right, near}));
  // The second slab is not behind its own rim.
  EXPECT_FALSE(covered.goes_on(2, 1, {true, bottom, Vector3(0.4, 0, 0), right, near}));
  return covered.goes_on(2, 0, {true, bottom, Vector3(0, 0, 0), right, near});
}

TEST(SurfaceContinuation, ABlockOnTwoLiesOnOneSurface) {
  EXPECT_TRUE(goes_on(0.0, 0.0, 0.0));
  EXPECT_TRUE(goes_on(0.0, 0.0, 1e-4)) << "as near as the first";
  EXPECT_TRUE(goes_on(0.0, -1e-5, -2e-5)) << "lower, but touched";
  EXPECT_TRUE(goes_on(5e-4, 0.0, -1e-5)) << "a narrow joint";
}

TEST(SurfaceContinuation, RimsAreEndsWhereNothingIsBehindThem) {
  EXPECT_FALSE(goes_on(2e-3, 0.0, -1e-5)) << "a wide joint";
  EXPECT_FALSE(goes_on(0.0, -1e-4, -1e-5)) << "lower, not touched";
  EXPECT_FALSE(goes_on(0.0, -1e-4, 1e-5)) << "lower";
  EXPECT_FALSE(goes_on(0.0, 0.0, 0.0, 1e-3)) << "the other half of a roof";
}

}  // namespace
}  // namespace ashlar::surface_continuation_test

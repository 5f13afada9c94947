#include "geometry/solid/rounded_convexity.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/shapes.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar::rounded_convexity_test {
namespace {

/// A unit cube whose top has a corner that is lower by `dent`, so that the diagonal to it is a reflex edge, with
/// its points numbered from another one on.
Polyhedron dented_cube(double dent, int first) {
  TriangleMesh cube;
  cube.points.resize(8);
  const auto number = [first](int k) { return (k + first) % 8; };
  for (int k = 0; k < 8; ++k)
    cube.points[static_cast<std::size_t>(number(k))] =
        Vector3(k & 1, k >> 1 & 1, k == 7 ? 1.0 - dent : k >> 2);
  cube.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  for (auto& triangle : cube.triangles)
    for (int& corner : triangle) corner = number(corner);
  return Polyhedron(std::move(cube));
}

// The two diagonals of the top are half the dent apart, a little less as they are tilted. A unit in the last
// place of the greatest coordinate, 1, is 2^-52.
TEST(RoundedConvexity, ADentOfEightUnitsIsRoundingHoweverPointsAreNumbered) {
  for (int first = 0; first < 8; ++first) {
    for (const double dent : {0x1p-53, 16.0 * 0x1p-52}) {
      const Polyhedron solid = dented_cube(dent, first);
      EXPECT_FALSE(solid.convex());
      EXPECT_TRUE(is_convex_but_for_rounding(solid)) << first << ' ' << dent;
    }
    EXPECT_FALSE(is_convex_but_for_rounding(dented_cube(16.5 * 0x1p-52, first))) << first;
  }
  EXPECT_FALSE(is_convex_but_for_rounding(Polyhedron(test_support::make_l_prism())));
}

TEST(RoundedConvexity, AConvexSolidIsConvex) {
  EXPECT_TRUE(is_convex_but_for_rounding(Polyhedron(make_box({0, 0, 0}, {1, 2, 3}))));
}

}  // namespace
}  // namespace ashlar::rounded_convexity_test

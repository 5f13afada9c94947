#include "geometry/convex/plane_heights.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/shapes.hpp"

namespace ashlar::plane_heights_test {
namespace {

// The normals of a box of three by one by one are products of two edges: 1 for the ends, 3 for the sides.
TEST(PlaneHeights, OfABoxOverABox) {
  const ConvexShape a = ConvexShape::from_mesh(make_box({0, 0, 0}, {3, 1, 1}));
  const ConvexShape b = ConvexShape::from_mesh(make_box({1, 1, 3}, {2, 5, 4}));
  PlaneHeights heights(a, b);
  int tops = 0;
  for (int f = 0; f < a.facet_count(); ++f) {
    heights.compute(f);
    if (a.normal_numbers(f).tracked.z.value <= 0.0) continue;
    ++tops;
    EXPECT_EQ(heights.lowest(f), 3.0 * 2.0);
    EXPECT_EQ(heights.highest(f), 3.0 * 3.0);
    for (std::size_t v = 0; v < b.corners().size(); ++v)
      EXPECT_EQ(heights.row(f)[v], 3.0 * (b.corners()[v][2] - 1.0));
    EXPECT_GT(heights.error(f), 0.0);
    EXPECT_LT(heights.error(f), 0x1p-40);
    EXPECT_GE(heights.difference_error(f), 2.0 * heights.error(f));
  }
  EXPECT_EQ(tops, 1);
}

// Coordinates of 53 bits: the error of the value is below the bound, by exact comparison of N.(y - x) with both
// ends of the interval.
TEST(PlaneHeights, TheBoundHolds) {
  const double third = 1.0 / 3.0, seventh = 1.0 / 7.0;
  const ConvexShape a = ConvexShape::from_mesh(make_convex_hull(
      std::vector<Vector3>{{0, third, 0}, {1, 0, seventh}, {seventh, 1, third}, {third, seventh, 1}}));
  const ConvexShape b = ConvexShape::from_mesh(make_box({seventh, 3, third}, {1, 4 + third, 7 * third}));
  PlaneHeights heights(a, b);
  for (int f = 0; f < a.facet_count(); ++f) {
    heights.compute(f);
    const NumberVector<DoubleDouble>& n = a.normal_numbers(f).double_double;
    const Vector3& x = a.corners()[a.facet(f)[0]];
    for (std::size_t v = 0; v < b.corners().size(); ++v) {
      const Difference d{&b.corners()[v], &x};
      const DoubleDouble height = dot(n, evaluate<DoubleDouble>(d));
      EXPECT_NE(sign_of(height - DoubleDouble(heights.row(f)[v] + heights.error(f))), 1);
      EXPECT_NE(sign_of(height - DoubleDouble(heights.row(f)[v] - heights.error(f))), -1);
    }
  }
}

}  // namespace
}  // namespace ashlar::plane_heights_test

#include "geometry/solid/solid_location.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/shapes.hpp"

namespace ashlar::solid_location_test {
namespace {

TEST(SolidLocation, InsideAndOutside) {
  const TriangleMesh box = make_box({0, 0, 0}, {2, 2, 2});
  EXPECT_TRUE(is_inside(box, {1, 1, 1}));
  EXPECT_FALSE(is_inside(box, {1, 1, 3}));
  // The ray (1, 3, 9) meets a corner.
  EXPECT_TRUE(is_inside(box, {2 - 1.0 / 8, 2 - 3.0 / 8, 2 - 9.0 / 8}));
}

/// On faces, on diagonals of faces, on edges and at corners the place next to it along (1, 3, 9) decides.
TEST(SolidLocation, OnTheSurface) {
  const TriangleMesh box = make_box({0, 0, 0}, {2, 2, 2});
  for (const Vector3& low : {Vector3(0.5, 1.25, 0), Vector3(1, 1, 0), Vector3(0, 1, 0), Vector3(0, 0, 0)})
    EXPECT_TRUE(is_inside(box, low)) << low.transpose();
  for (const Vector3& high : {Vector3(0.5, 1.25, 2), Vector3(1, 1, 2), Vector3(2, 1, 2), Vector3(2, 2, 2)})
    EXPECT_FALSE(is_inside(box, high)) << high.transpose();
  // From an edge on the other side the ray enters, or does not.
  EXPECT_FALSE(is_inside(box, {2, 1, 0}));
  EXPECT_FALSE(is_inside(box, {0, 2, 0}));
}

}  // namespace
}  // namespace ashlar::solid_location_test

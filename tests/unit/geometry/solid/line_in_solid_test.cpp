#include "geometry/solid/line_in_solid.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/shapes.hpp"

namespace ashlar::line_in_solid_test {
namespace {

using Parts = std::vector<std::array<double, 2>>;

TEST(LineInSolid, EntersAndLeavesABox) {
  const TriangleMesh box = make_box({0, 0, 0}, {1, 2, 3});
  EXPECT_EQ(parts_inside(box, {0.3, 0.4, -1}, {0, 0, 1}, 0.0, 10.0), (Parts{{1.0, 4.0}}));
  EXPECT_EQ(parts_inside(box, {0.3, 0.4, -1}, {0, 0, 1}, 2.0, 3.0), (Parts{{2.0, 3.0}}));
  EXPECT_TRUE(parts_inside(box, {1.3, 0.4, -1}, {0, 0, 1}, 0.0, 10.0).empty());
}

TEST(LineInSolid, GoesThroughEdgesAndCorners) {
  const TriangleMesh box = make_box({0, 0, 0}, {2, 2, 2});
  // Along the diagonal of faces' triangles, from edge to edge and from corner to corner.
  EXPECT_EQ(parts_inside(box, {-1, 1, -1}, {1, 0, 1}, 0.0, 10.0), (Parts{{1.0, 3.0}}));
  EXPECT_EQ(parts_inside(box, {-1, -1, -1}, {1, 1, 1}, 0.0, 10.0), (Parts{{1.0, 3.0}}));
  // Touches an edge from outside.
  EXPECT_TRUE(parts_inside(box, {-1, 1, 1}, {1, 0, -1}, -10.0, 0.5).empty());
}

TEST(LineInSolid, OneOfTwoSolidsHasALineInTheirCommonFace) {
  const TriangleMesh left = make_box({0, 0, 0}, {1, 1, 1}), right = make_box({1, 0, 0}, {2, 1, 1});
  const TriangleMesh below = make_box({0, 0, -1}, {1, 1, 0});
  const auto count = [](const TriangleMesh& solid, const Vector3& start, const Vector3& direction) {
    return parts_inside(solid, start, direction, 0.0, 10.0).size();
  };
  EXPECT_EQ(count(left, {1, 0.3, -2}, {0, 0, 1}) + count(right, {1, 0.3, -2}, {0, 0, 1}), 1U);
  EXPECT_EQ(count(left, {0.3, -2, 0}, {0, 1, 0}) + count(below, {0.3, -2, 0}, {0, 1, 0}), 1U);
}

TEST(LineInSolid, LeavesANotch) {
  // Two boxes with a gap as one surface.
  TriangleMesh both = make_box({0, 0, 0}, {1, 1, 1});
  const TriangleMesh other = make_box({0, 0, 1.5}, {1, 1, 2});
  const auto first = static_cast<int>(both.points.size());
  both.points.insert(both.points.end(), other.points.begin(), other.points.end());
  for (auto triangle : other.triangles) {
    for (auto& corner : triangle) corner += static_cast<std::remove_reference_t<decltype(corner)>>(first);
    both.triangles.push_back(triangle);
  }
  EXPECT_EQ(parts_inside(both, {0.25, 0.5, 0.5}, {0, 0, 1}, 0.0, 10.0), (Parts{{0.0, 0.5}, {1.0, 1.5}}));
}

}  // namespace
}  // namespace ashlar::line_in_solid_test

#include "geometry/solid/shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "geometry/solid/polyhedron.hpp"

namespace ashlar::shapes_test {
namespace {

using testing::SizeIs;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<Vector3> grid_points(int n) {
  std::vector<Vector3> points;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      for (int k = 0; k <= n; ++k) points.emplace_back(i, j, k);
    }
  }
  return points;
}

TEST(Box, is_a_solid_of_its_size) {
  const Polyhedron p(make_box({-1, 2, 0.5}, {3, 2.25, 1.5}));
  EXPECT_EQ(p.volume(), 1.0);
  EXPECT_THAT(p.mesh().triangles, SizeIs(12));
  EXPECT_THAT(p.faces(), SizeIs(6));
}

TEST(Box, refuses_empty_and_non_finite_extents) {
  EXPECT_THROW((void)make_box({0, 0, 0}, {1, 0, 1}), std::invalid_argument);
  EXPECT_THROW((void)make_box({0, 0, 2}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW((void)make_box({0, nan, 0}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW((void)make_box({0, 0, 0}, {1, infinity, 1}), std::invalid_argument);
}

TEST(ConvexHull, of_a_grid_is_a_cube_with_merged_faces) {
  for (const int n : {1, 2, 4}) {
    const Polyhedron p(make_convex_hull(grid_points(n)));
    EXPECT_EQ(p.volume(), n * n * n);
    EXPECT_TRUE(p.convex());
    EXPECT_THAT(p.faces(), SizeIs(6));
    EXPECT_THAT(p.edges(), SizeIs(12));
    EXPECT_THAT(p.corners(), SizeIs(8));
  }
}

TEST(ConvexHull, of_an_octahedron_with_repeated_and_inner_points) {
  const std::vector<Vector3> points{{1, 0, 0}, {-1, 0, 0},  {0, 1, 0},        {0, -1, 0},
                                    {0, 0, 1}, {0, 0, -1},  {0, 0, -1},       {1, 0, 0},
                                    {0, 0, 0}, {0.1, 0, 0}, {0.25, 0.25, 0.5}};
  const Polyhedron p(make_convex_hull(points));
  EXPECT_EQ(p.volume(), 4.0 / 3.0);
  EXPECT_THAT(p.faces(), SizeIs(8));
  EXPECT_THAT(p.edges(), SizeIs(12));
  EXPECT_THAT(p.corners(), SizeIs(6));
}

// Few grid values make many points coplanar and collinear.
TEST(ConvexHull, of_random_grid_points_supports_all_of_them) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<Vector3> points;
    const int count = 6 + static_cast<int>(random() % 30);
    points.reserve(static_cast<std::size_t>(count) + 4);
    for (int i = 0; i < count; ++i) points.emplace_back(random() % 4, random() % 4, random() % 4);
    points.insert(points.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    const Polyhedron p(make_convex_hull(points));
    EXPECT_TRUE(p.convex());
    EXPECT_EQ(p.corners().size() + p.faces().size(), p.edges().size() + 2);
    for (const PolyhedronFace& face : p.faces()) {
      const auto& loop = face.loops[0];
      const Vector3& a = p.mesh().points[loop[0]];
      const Vector3 n = (p.mesh().points[loop[1]] - a).cross(p.mesh().points[loop[2]] - a);  // exact integers
      EXPECT_TRUE(face.convex);
      for (const Vector3& q : points) EXPECT_LE(n.dot(q - a), 0.0);
    }
    std::reverse(points.begin(), points.end());
    const Polyhedron reversed(make_convex_hull(points));
    EXPECT_EQ(reversed.volume(), p.volume());
    EXPECT_EQ(reversed.faces().size(), p.faces().size());
    EXPECT_EQ(reversed.edges().size(), p.edges().size());
  }
}

TEST(ConvexHull, refuses_points_without_volume) {
  const std::vector<Vector3> three{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_THROW((void)make_convex_hull(three), std::invalid_argument);
  const std::vector<Vector3> same(5, Vector3(1, 2, 3));
  EXPECT_THROW((void)make_convex_hull(same), std::invalid_argument);
  const std::vector<Vector3> line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}};
  EXPECT_THROW((void)make_convex_hull(line), std::invalid_argument);
  const std::vector<Vector3> plane{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0.3, 0.7, 1}};
  EXPECT_THROW((void)make_convex_hull(plane), std::invalid_argument);
  const std::vector<Vector3> bad{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, nan}};
  EXPECT_THROW((void)make_convex_hull(bad), std::invalid_argument);
}

TEST(ConvexHull, one_ulp_makes_a_volume) {
  std::vector<Vector3> points{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, std::nextafter(1.0, 2.0)}};
  // Base triangle of area 1/2 under a height of one ulp.
  EXPECT_EQ(Polyhedron(make_convex_hull(points)).volume(), std::numeric_limits<double>::epsilon() / 6.0);
}

TEST(Sphere, is_convex_with_all_points_at_the_radius) {
  const Vector3 center(1, -2, 3);
  for (int s = 0; s <= 4; ++s) {
    const Polyhedron p(make_sphere(center, 2.5, s));
    EXPECT_THAT(p.mesh().triangles, SizeIs(20 << (2 * s)));
    EXPECT_THAT(p.mesh().points, SizeIs((10 << (2 * s)) + 2));
    EXPECT_TRUE(p.convex());
    for (const Vector3& q : p.mesh().points) EXPECT_NEAR((q - center).norm(), 2.5, 4e-15);
  }
}

TEST(Sphere, volume_grows_to_that_of_the_ball) {
  // Regular icosahedron with circumradius 1: edge a = 4 / sqrt(10 + 2 sqrt 5), volume 5 (3 + sqrt 5) a^3
  // / 12.
  const double root = std::sqrt(5.0);
  const double a = 4.0 / std::sqrt(10.0 + 2.0 * root);
  EXPECT_NEAR(Polyhedron(make_sphere({0, 0, 0}, 1.0, 0)).volume(), 5.0 * (3.0 + root) * a * a * a / 12.0,
              1e-14);
  const double ball = 4.0 * std::acos(-1.0) / 3.0;
  double last_error = ball;
  for (int s = 0; s <= 5; ++s) {
    const double error = ball - Polyhedron(make_sphere({0, 0, 0}, 1.0, s)).volume();
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, 0.4 * last_error);
    last_error = error;
  }
}

TEST(Sphere, refuses_bad_arguments) {
  EXPECT_THROW((void)make_sphere({0, 0, 0}, 0.0, 1), std::invalid_argument);
  EXPECT_THROW((void)make_sphere({0, 0, 0}, -1.0, 1), std::invalid_argument);
  EXPECT_THROW((void)make_sphere({0, 0, 0}, nan, 1), std::invalid_argument);
  EXPECT_THROW((void)make_sphere({0, 0, infinity}, 1.0, 1), std::invalid_argument);
  EXPECT_THROW((void)make_sphere({0, 0, 0}, 1.0, -1), std::invalid_argument);
  EXPECT_THROW((void)make_sphere({0, 0, 0}, 1.0, 8), std::invalid_argument);
}

TEST(ConvexHull, divides_facets_into_fans_from_their_first_corner) {
  // Prism over a convex polygon with 12 corners; its middle and the middles of its sides are dropped.
  const std::vector<std::array<int, 2>> polygon = {{5, 1},   {4, 3},   {2, 5},   {-1, 5}, {-3, 4}, {-5, 2},
                                                   {-5, -1}, {-4, -3}, {-2, -5}, {1, -5}, {3, -4}, {5, -2}};
  std::vector<Vector3> points;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    for (const double z : {0.0, 1.0, 2.0}) points.emplace_back(polygon[k][0], polygon[k][1], z);
  for (const double z : {0.0, 1.0, 2.0}) points.emplace_back(1, 1, z);
  std::mt19937_64 random(3);
  for (int round = 0; round < 20; ++round) {
    for (std::size_t k = points.size() - 1; k > 0; --k) std::swap(points[k], points[random() % (k + 1)]);
    const TriangleMesh hull = make_convex_hull(points);
    std::vector<Vector3> corners;
    for (const Vector3& point : points)
      if (point.z() != 1.0 && point.head<2>() != Eigen::Vector2d(1, 1)) corners.push_back(point);
    EXPECT_EQ(hull.points, corners);
    const Polyhedron p(hull);
    EXPECT_THAT(p.faces(), SizeIs(14));
    for (const PolyhedronFace& face : p.faces()) {
      const int first = *std::min_element(face.loops[0].begin(), face.loops[0].end());
      for (const int t : face.triangles) EXPECT_EQ(p.mesh().triangles[t][0], first);
    }
  }
}

TEST(ConvexHull, numbers_points_as_they_were_given) {
  // Two of these points are inside, one is given twice.
  const std::vector<Vector3> points = {{1, 0, 0}, {0.2, 0.2, 0.2}, {0, 0, 1}, {0, 0, 0},
                                       {1, 0, 0}, {0.1, 0.3, 0.2}, {0, 1, 0}};
  const TriangleMesh hull = make_convex_hull(points);
  EXPECT_EQ(hull.points, (std::vector<Vector3>{{1, 0, 0}, {0, 0, 1}, {0, 0, 0}, {0, 1, 0}}));
  // Outward triangles, each from its least corner on.
  EXPECT_EQ(hull.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}));
}

}  // namespace
}  // namespace ashlar::shapes_test

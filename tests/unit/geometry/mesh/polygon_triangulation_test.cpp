#include "geometry/mesh/polygon_triangulation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>

namespace ashlar::polygon_triangulation_test {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

/// A star with `spikes` reflex corners, counter-clockwise.
std::vector<Vector3> star(int spikes) {
  std::vector<Vector3> points;
  for (int k = 0; k < 2 * spikes; ++k) {
    const double angle = std::numbers::pi * k / spikes;
    const double radius = k % 2 == 0 ? 2.0 : 1.0;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
  return points;
}

std::vector<int> all_of(const std::vector<Vector3>& points) {
  std::vector<int> corners(points.size());
  std::iota(corners.begin(), corners.end(), 0);
  return corners;
}

double area(const std::vector<Vector3>& points, const Triangles& triangles) {
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles)
    sum += 0.5 * (points[b] - points[a]).cross(points[c] - points[a]).z();
  return sum;
}

TEST(PolygonTriangulation, EarsCoverAStarOnce) {
  for (const int spikes : {3, 4, 7, 50}) {
    const auto points = star(spikes);
    Triangles triangles;
    std::size_t tests_left = 1'000'000;
    triangulate_polygon(points, all_of(points), triangles, tests_left);
    ASSERT_EQ(triangles.size(), points.size() - 2);
    // 2 n triangles from the middle with sides 1 and 2 at an angle of pi / n.
    EXPECT_NEAR(area(points, triangles), 2.0 * spikes * std::sin(std::numbers::pi / spikes), 1e-12);
    for (const auto& triangle : triangles) EXPECT_GT(area(points, {triangle}), 0.0);
  }
}

TEST(PolygonTriangulation, AConvexPolygonNeedsNoTests) {
  std::vector<Vector3> points;
  constexpr int count = 20'000;
  for (int k = 0; k < count; ++k) points.emplace_back(k, static_cast<double>(k) * k, 0.0);  // on a parabola
  Triangles triangles;
  std::size_t tests_left = 0;
  triangulate_polygon(points, all_of(points), triangles, tests_left);
  ASSERT_EQ(triangles.size(), count - 2U);
  EXPECT_EQ(triangles.front(), (std::array{0, 1, 2}));
  EXPECT_EQ(triangles.back(), (std::array{0, count - 2, count - 1}));
}

/// A triangle by its places, from the least one on in its direction.
using PlacedTriangle = std::array<std::array<double, 3>, 3>;

std::set<PlacedTriangle> divided(const std::vector<Vector3>& points, const std::vector<int>& corners) {
  Triangles triangles;
  std::size_t tests_left = 1'000'000;
  triangulate_polygon(points, corners, triangles, tests_left);
  std::set<PlacedTriangle> result;
  for (const auto& triangle : triangles) {
    PlacedTriangle placed;
    for (std::size_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis) placed[k][axis] = points[triangle[k]][axis];
    std::rotate(placed.begin(), std::min_element(placed.begin(), placed.end()), placed.end());
    result.insert(placed);
  }
  EXPECT_EQ(result.size(), triangles.size());
  return result;
}

std::set<PlacedTriangle> mirrored(const std::set<PlacedTriangle>& triangles) {
  std::set<PlacedTriangle> result;
  for (PlacedTriangle triangle : triangles) {
    std::swap(triangle[1], triangle[2]);
    result.insert(triangle);
  }
  return result;
}

/// A polygon around the middle of a plane of any direction, its corners off the plane by up to 1 mm. Coordinates
/// are multiples of 2^-20 below 4, so that they can be moved by such multiples without rounding.
std::vector<Vector3> warped_polygon(std::mt19937& random, int corners) {
  const auto between = [&random](double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(random()), -32);
  };
  const Vector3 normal = Vector3(between(-1, 1), between(-1, 1), between(0.1, 1)).normalized();
  const Vector3 u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Vector3> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + between(0.1, 0.9)) / corners;
    const double radius = between(0.3, 1.0);
    const Vector3 place =
        radius * (std::cos(angle) * u + std::sin(angle) * v) + between(-1e-3, 1e-3) * normal;
    points.push_back((place * 0x1p20).array().round().matrix() * 0x1p-20);
  }
  return points;
}

// The triangles of a polygon are those of its places, whoever names it.
TEST(PolygonTriangulation, IsTheSameFromEveryCornerEitherWayAndAnywhere) {
  std::mt19937 random(7);
  for (int n = 0; n < 600; ++n) {
    const std::vector<Vector3> points = warped_polygon(random, 4 + n % 9);
    const std::vector<int> ring = all_of(points);
    const auto triangles = divided(points, ring);
    ASSERT_EQ(triangles.size(), points.size() - 2);
    const Vector3 shift(std::ldexp(static_cast<double>(random() % 4096), -10), -1.5, 0x1p-20);
    for (std::size_t start = 0; start < ring.size(); ++start) {
      std::vector<int> turned = ring;
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(start), turned.end());
      EXPECT_EQ(divided(points, turned), triangles);
      // In another block's numbers, and seen from the other side.
      std::vector<int> number = ring;
      std::shuffle(number.begin(), number.end(), random);
      std::vector<Vector3> renumbered(points.size()), moved(points.size());
      for (const int corner : ring) renumbered[number[corner]] = points[corner];
      std::vector<int> backwards;
      for (auto corner = turned.rbegin(); corner != turned.rend(); ++corner)
        backwards.push_back(number[*corner]);
      EXPECT_EQ(divided(renumbered, backwards), mirrored(triangles));
      for (const int corner : ring) moved[number[corner]] = points[corner] + shift;
      std::vector<int> forwards(backwards.rbegin(), backwards.rend());
      std::set<PlacedTriangle> elsewhere;
      for (PlacedTriangle triangle : triangles) {
        for (auto& place : triangle)
          for (int axis = 0; axis < 3; ++axis) place[axis] += shift[axis];
        elsewhere.insert(triangle);
      }
      EXPECT_EQ(divided(moved, forwards), elsewhere);
    }
  }
}

// A quadrangle that is not plane, by hand: the fan from the least corner, (0, 0, 0).
TEST(PolygonTriangulation, FansFromTheLeastCorner) {
  const std::vector<Vector3> points = {{1, 0, 0.001}, {1, 1, 0}, {0, 1, 0.001}, {0, 0, 0}};
  const std::set<PlacedTriangle> expected = {{{{0, 0, 0}, {1, 0, 0.001}, {1, 1, 0}}},
                                             {{{0, 0, 0}, {1, 1, 0}, {0, 1, 0.001}}}};
  EXPECT_EQ(divided(points, {0, 1, 2, 3}), expected);
  EXPECT_EQ(divided(points, {2, 3, 0, 1}), expected);
  EXPECT_EQ(divided(points, {1, 0, 3, 2}), mirrored(expected));
}

// Corners on one place, as where a hole is joined to the rim, and all on one place: the least start is then
// decided by the following corners, in linear time.
TEST(PolygonTriangulation, ComparesWhatFollowsEqualCorners) {
  const std::vector<Vector3> points = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0},
                                       {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
  const std::vector<int> joined = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  const auto triangles = divided(points, joined);
  for (std::size_t start = 1; start < joined.size(); ++start) {
    std::vector<int> turned = joined;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(start), turned.end());
    EXPECT_EQ(divided(points, turned), triangles);
    std::reverse(turned.begin(), turned.end());
    EXPECT_EQ(divided(points, turned), mirrored(triangles));
  }
  const std::vector<Vector3> one_place(200'000, Vector3(1, 2, 3));
  Triangles none;
  std::size_t tests_left = 10;
  triangulate_polygon(one_place, all_of(one_place), none, tests_left);
  EXPECT_EQ(none.size(), one_place.size() - 2);
}

TEST(PolygonTriangulation, StopsWhenItsTestsAreSpent) {
  const auto points = star(50);
  Triangles triangles;
  std::size_t tests_left = 1'000'000;
  triangulate_polygon(points, all_of(points), triangles, tests_left);
  const std::size_t needed = 1'000'000 - tests_left;
  EXPECT_GT(needed, 50U);
  std::size_t just_enough = needed;
  triangulate_polygon(points, all_of(points), triangles, just_enough);
  EXPECT_EQ(just_enough, 0U);
  std::size_t too_few = needed - 1;
  EXPECT_THROW(triangulate_polygon(points, all_of(points), triangles, too_few), std::length_error);
}

}  // namespace
}  // namespace ashlar::polygon_triangulation_test

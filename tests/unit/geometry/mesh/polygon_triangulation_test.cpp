#include "geometry/mesh/polygon_triangulation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace ashlar {
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
}  // namespace ashlar

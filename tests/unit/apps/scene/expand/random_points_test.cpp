#include "apps/scene/expand/random_points.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "apps/scene/expand/joint_planes.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar::random_points_test {
namespace {

/// A box with a corner at the origin, turned about it.
Polyhedron turned_box(const Vector3& size, const Eigen::Matrix3d& turn) {
  const Polyhedron box(make_box(Vector3::Zero(), size));
  std::vector<Vector3> points;
  for (const Vector3& point : box.mesh().points) points.emplace_back(turn * point);
  return box.with_points(points);
}

Eigen::Matrix3d some_turn() {
  return Eigen::AngleAxisd(0.9, Vector3(1, -2, 3).normalized()).toRotationMatrix();
}

TEST(RandomPoints, AreInsideSolidsThatFillLittleOfTheirBox) {
  for (const Vector3& size : {Vector3(1e4, 1, 1), Vector3(1e5, 1e5, 0.1), Vector3(1, 1, 1)}) {
    std::mt19937_64 random = random_stream(1, RandomStream::points);
    for (const Vector3& point : random_points(turned_box(size, some_turn()), 1000, random)) {
      const Vector3 local = some_turn().transpose() * point;
      // Rounding of coordinates of 1e5 m is below 1e-9 m.
      EXPECT_TRUE((local.array() > -1e-9).all() && (local.array() < size.array() + 1e-9).all())
          << local.transpose();
    }
  }
}

// With 64,000 points in 4 x 4 x 4 equal cells each has 1000 in the mean, with a standard deviation of
// sqrt(64000 (1/64) (63/64)) = 31.4; five of them are exceeded by one in 27,000 draws of all cells.
TEST(RandomPoints, AreEvenlySpread) {
  const Vector3 size(8, 1, 0.25);
  std::mt19937_64 random = random_stream(7, RandomStream::points);
  std::array<int, 64> cells = {};
  for (const Vector3& point : random_points(turned_box(size, some_turn()), 64000, random)) {
    const Vector3 share = (some_turn().transpose() * point).cwiseQuotient(size) * 4.0;
    const auto place = [&](int axis) { return std::min(3, static_cast<int>(share[axis])); };
    ++cells[static_cast<std::size_t>(place(0) + 4 * place(1) + 16 * place(2))];
  }
  for (const int cell : cells) EXPECT_NEAR(cell, 1000, 5 * 31.4);
}

TEST(RandomPoints, AreTheSameOfTheSameSeed) {
  const Polyhedron sphere(make_sphere(Vector3(1e6, 0, 0), 2.0, 2));
  std::mt19937_64 first = random_stream(3, RandomStream::points), again = first;
  EXPECT_EQ(random_points(sphere, 20, first), random_points(sphere, 20, again));
  EXPECT_NE(random_points(sphere, 1, first), random_points(sphere, 20, again));
  EXPECT_TRUE(random_points(sphere, 0, first).empty());
}

TEST(RandomPoints, SizesNearTheLimitsOfDoublesDoNotMatter) {
  std::mt19937_64 random = random_stream(3, RandomStream::points);
  const Polyhedron large(make_box(Vector3::Zero(), Vector3::Constant(1e100)));
  for (const Vector3& point : random_points(large, 10, random))
    EXPECT_TRUE((point.array() > 0.0).all() && (point.array() < 1e100).all());
}

}  // namespace
}  // namespace ashlar::random_points_test

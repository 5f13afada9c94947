#include "geometry/cutting/tetrahedra.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <random>

#include "geometry/solid/hull_solid.hpp"
#include "support/sample_meshes.hpp"
#include "support/sample_solids.hpp"

namespace ashlar::tetrahedra_test {
namespace {

double volume_of(const TetrahedronMesh& mesh, const std::array<int, 4>& cell) {
  const auto corner = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(cell[k])]; };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(corner(3) - corner(0)) / 6.0;
}

double total_volume(const TetrahedronMesh& mesh) {
  double sum = 0.0;
  for (const auto& cell : mesh.cells) {
    const double volume = volume_of(mesh, cell);
    EXPECT_GT(volume, 0.0);
    sum += volume;
  }
  return sum;
}

/// Area of the faces that belong to one cell only; every other one must belong to two.
double free_area(const TetrahedronMesh& mesh) {
  std::map<std::array<int, 3>, int> count;
  for (const auto& cell : mesh.cells) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<int, 3> face{};
      for (std::size_t k = 0, n = 0; k < 4; ++k)
        if (k != left_out) face[n++] = cell[k];
      std::sort(face.begin(), face.end());
      ++count[face];
    }
  }
  double area = 0.0;
  for (const auto& counted : count) {
    EXPECT_LE(counted.second, 2);
    if (counted.second == 2) continue;
    const auto corner = [&](std::size_t k) {
      return mesh.points[static_cast<std::size_t>(counted.first[k])];
    };
    area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  return area;
}

void expect_filled(const Polyhedron& solid, double volume, double area) {
  const TetrahedronMesh mesh = tetrahedra_of(solid, 0.0);
  EXPECT_NEAR(total_volume(mesh) / volume, 1.0, 1e-12);
  EXPECT_NEAR(free_area(mesh) / area, 1.0, 1e-12);
}

TEST(Tetrahedra, ABoxIsAStarOfItsTriangles) {
  const TetrahedronMesh mesh = tetrahedra_of(Polyhedron(make_box({0, 0, 0}, {1, 2, 3})), 0.0);
  EXPECT_EQ(mesh.cells.size(), 12U);
  ASSERT_EQ(mesh.points.size(), 9U);
  EXPECT_NEAR((mesh.points.back() - Vector3(0.5, 1, 1.5)).norm(), 0.0, 1e-15);
  // Each face with half of the height of its box: a third of half of what base times height is, halved by its diagonal.
  for (const auto& cell : mesh.cells) EXPECT_NEAR(volume_of(mesh, cell), 0.5, 1e-14);
}

TEST(Tetrahedra, FillSolidsThatAPointSees) {
  expect_filled(Polyhedron(make_box({0, 0, 0}, {1, 1, 1e-6})), 1e-6, 2.0 + 4e-6);
  // Two squares of an L each have 3 m^2, its sides 8 m of 1 m.
  expect_filled(Polyhedron(test_support::make_l_prism()), 3.0, 14.0);
  // A cube of 3 m without one of 2 m in its corner has the cube's area.
  expect_filled(Polyhedron(test_support::make_corner()), 19.0, 54.0);
}

TEST(Tetrahedra, AnLIsSeenFromItsInnerSquare) {
  // An L is star-shaped about points with x < 1 and y < 1, such as its centroid (5/6, 5/6, 1/2).
  const TetrahedronMesh mesh = tetrahedra_of(Polyhedron(test_support::make_l_prism()), 0.0);
  EXPECT_NEAR((mesh.points.back() - Vector3(5, 5, 3) / 6.0).norm(), 0.0, 1e-15);
  EXPECT_EQ(mesh.cells.size(), 20U);
  // With arms of 10 m, 19 m^2, the centroid has x = y = (10 * 5 + 9 * 0.5) / 19 = 2.87, and the middle of the square is taken.
  TriangleMesh slender = test_support::make_l_prism();
  for (Vector3& point : slender.points)
    for (int axis = 0; axis < 2; ++axis)
      if (point[axis] == 2.0) point[axis] = 10.0;
  const TetrahedronMesh arms = tetrahedra_of(Polyhedron(slender), 0.0);
  EXPECT_NEAR((arms.points.back() - Vector3(0.5, 0.5, 0.5)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(total_volume(arms), 19.0, 1e-12);
}

TEST(Tetrahedra, FillSolidsThatNoPointSees) {
  // A square of 9 m^2 with a hole of 1 m^2, 1 m high, with 12 m and 4 m of sides.
  expect_filled(Polyhedron(test_support::make_frame()), 8.0, 2.0 * 8.0 + 16.0);
}

/// A U of two arms, turned: 3 by 3 m without 1 by 2 m, 1 m high.
TriangleMesh make_u() {
  return test_support::make_prism({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},
                                  {{0, 1, 5}, {1, 4, 5}, {1, 2, 4}, {2, 3, 4}, {0, 5, 7}, {5, 6, 7}},
                                  {{0, 1, 2, 3, 4, 5, 6, 7}}, 1.0);
}

TEST(Tetrahedra, FillTurnedSolidsWhoseFacesAreFlatButForRounding) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (const TriangleMesh& mesh : {make_u(), test_support::make_frame()}) {
    const Polyhedron exact(mesh);
    for (int turn = 0; turn < 4; ++turn) {
      const Eigen::Quaterniond rotation =
          Eigen::Quaterniond(share(random), share(random), share(random), share(random)).normalized();
      std::vector<Vector3> points;
      for (const Vector3& point : mesh.points) points.push_back(rotation * point + Vector3(10, 20, 30));
      const Polyhedron solid = exact.with_points(points);
      const TetrahedronMesh cells = tetrahedra_of(solid, 0x1p-46 * 40.0);
      EXPECT_NEAR(total_volume(cells) / solid.volume(), 1.0, 1e-12) << turn;
    }
  }
}

TEST(Tetrahedra, FillHullsAndTheirTranslations) {
  for (const auto& [name, solid] : test_support::sample_solids()) {
    const TetrahedronMesh mesh = tetrahedra_of(solid, 0.0);
    EXPECT_NEAR(total_volume(mesh) / solid.volume(), 1.0, 1e-12) << name;
    EXPECT_NEAR(total_volume(translated(mesh, {0.1, 7, -3})) / solid.volume(), 1.0, 1e-11) << name;
  }
}

TEST(Tetrahedra, NoneIsFlatterThanItsSolid) {
  // The centroid of a convex solid is at least a quarter of its width from every face.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int seed = 0; seed < 20; ++seed) {
    std::vector<Vector3> points(12);
    for (Vector3& point : points)
      for (double& x : point) x = share(random);
    const Polyhedron solid = make_hull_solid(points, 0.0);
    const TetrahedronMesh mesh = tetrahedra_of(solid, 0.0);
    const Vector3 centre = mesh.points.back();
    for (const PolyhedronFace& face : solid.faces()) {
      double least = 0.0, most = 0.0;
      for (const Vector3& point : solid.mesh().points) {
        least = std::min(least, face.normal.dot(point - centre));
        most = std::max(most, face.normal.dot(point - centre));
      }
      EXPECT_GE(most, 0.25 * (most - least) - 1e-12);
    }
  }
}

}  // namespace
}  // namespace ashlar::tetrahedra_test

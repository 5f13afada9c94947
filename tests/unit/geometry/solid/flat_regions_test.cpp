#include "geometry/solid/flat_regions.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <random>
#include <set>

#include "geometry/solid/mesh_defects.hpp"
#include "geometry/solid/polyhedron.hpp"
#include "geometry/solid/shapes.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar::flat_regions_test {
namespace {

/// The triangles of a fan of four around a point above the middle of a square, and below it: a roof and a
/// keel.
TriangleMesh double_roof(double height) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, height}, {1, 1, -1}};
  for (int k = 0; k < 4; ++k) {
    mesh.triangles.push_back({k, (k + 1) % 4, 4});
    mesh.triangles.push_back({(k + 1) % 4, k, 5});
  }
  return mesh;
}

std::size_t regions_of(const TriangleMesh& mesh, double resolution) {
  const std::vector<int> regions = flat_regions(mesh, check_mesh(mesh, 1).twins, resolution);
  return std::set<int>(regions.begin(), regions.end()).size();
}

TriangleMesh turned(TriangleMesh mesh, std::mt19937& random) {
  std::normal_distribution<double> part;
  const Eigen::Quaterniond rotation =
      Eigen::Quaterniond(part(random), part(random), part(random), part(random)).normalized();
  for (Vector3& point : mesh.points) point = rotation * point;
  return mesh;
}

TEST(FlatRegions, ARoofAsHighAsTheResolutionIsFlat) {
  // The top's far corner is twice the height off the plane of each triangle; the keel's four stay apart.
  EXPECT_EQ(regions_of(double_roof(1e-9), 2.1e-9), 5U);
  EXPECT_EQ(regions_of(double_roof(1e-9), 0.9e-9), 8U);
}

TEST(FlatRegions, ASliverGoesWithOneOfItsNeighbours) {
  // The corner of a cube's upper edge at (1, 0, 1) - (1, 1, 1) with a third point on it that is 1e-15 outside
  // in x: two triangles next to it have no plane worth the name.
  TriangleMesh mesh = make_convex_hull(std::vector<Vector3>{{0, 0, 0},
                                                            {1, 0, 0},
                                                            {0, 1, 0},
                                                            {1, 1, 0},
                                                            {0, 0, 1},
                                                            {1, 0, 1},
                                                            {0, 1, 1},
                                                            {1, 1, 1},
                                                            {1 + 1e-15, 0.5, 1 - 1e-15}});
  EXPECT_EQ(regions_of(mesh, 1e-14), 6U);
}

TEST(FlatRegions, OppositeSidesOfAThinPlateStayApart) {
  EXPECT_GE(regions_of(make_box({0, 0, 0}, {1, 1, 1e-15}), 1e-14), 2U);
}

TEST(Polyhedron, TurnedInDoublePrecisionKeepsItsFaces) {
  std::mt19937 random(5);
  for (const TriangleMesh& shape : {make_box({0, 0, 0}, {3, 0.1, 1}), test_support::make_divided_cube(4),
                                    test_support::make_l_prism(), test_support::make_frame()}) {
    const Polyhedron exact(shape);
    for (int round = 0; round < 50; ++round) {
      const TriangleMesh mesh = turned(shape, random);
      const Polyhedron solid(mesh, 1e-14);
      EXPECT_EQ(solid.faces().size(), exact.faces().size());
      EXPECT_EQ(solid.edges().size(), exact.edges().size());
      EXPECT_EQ(solid.corners(), exact.corners());
      EXPECT_EQ(solid.convex(), exact.convex());
      EXPECT_EQ(std::count_if(solid.edges().begin(), solid.edges().end(), [](auto& e) { return e.convex; }),
                std::count_if(exact.edges().begin(), exact.edges().end(), [](auto& e) { return e.convex; }));
      EXPECT_EQ(std::count_if(solid.faces().begin(), solid.faces().end(), [](auto& f) { return f.convex; }),
                std::count_if(exact.faces().begin(), exact.faces().end(), [](auto& f) { return f.convex; }));
      EXPECT_NEAR(solid.volume(), exact.volume(), 1e-13 * exact.volume());
    }
  }
}

TEST(Polyhedron, AResolutionThatChangesNothingLeavesFacesBitForBit) {
  for (const TriangleMesh& shape :
       {make_box({0, 0, 0}, {3, 0.1, 1}), make_sphere({0, 0, 0}, 1.0, 4), test_support::make_frame()}) {
    const Polyhedron exact(shape);
    const Polyhedron solid(shape, 1e-14);
    ASSERT_EQ(solid.faces().size(), exact.faces().size());
    for (std::size_t f = 0; f < exact.faces().size(); ++f) {
      EXPECT_EQ(solid.faces()[f].normal, exact.faces()[f].normal);
      EXPECT_EQ(solid.faces()[f].triangles, exact.faces()[f].triangles);
      EXPECT_EQ(solid.faces()[f].loops, exact.faces()[f].loops);
    }
  }
}

}  // namespace
}  // namespace ashlar::flat_regions_test

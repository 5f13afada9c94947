#include "geometry/cutting/cut_solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "geometry/convex/convex_contact.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar {
namespace {

const CutSolid::Choice always = [](int) { return true; };

Polyhedron cube(double size) {
  return Polyhedron(make_box(Vector3::Zero(), Vector3::Constant(size)));
}

Polyhedron resolved(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (const Vector3& point : mesh.points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return Polyhedron(mesh, 0x1p-46 * largest);
}

double total_volume(const CutSolid& solid) {
  double sum = 0.0;
  for (const int piece : solid.pieces()) sum += solid.volume(piece);
  return sum;
}

TEST(CutSolid, CubeByThreeSetsIsUnitCubes) {
  CutSolid solid(cube(10.0));
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 1; k < 10; ++k)
      solid.cut({Vector3::Unit(axis), Vector3::Zero(), static_cast<double>(k)}, axis, always);
  const std::vector<int> pieces = solid.pieces();
  ASSERT_EQ(pieces.size(), 1000U);
  int shared = 0;
  for (const int piece : pieces) {
    EXPECT_EQ(solid.volume(piece), 1.0);
    const std::vector<PieceFace> faces = solid.faces(piece);
    ASSERT_EQ(faces.size(), 6U);
    for (const PieceFace& face : faces) {
      EXPECT_EQ(solid.area(face), 1.0);
      if (face.neighbour < 0) continue;
      ++shared;
      EXPECT_EQ(std::abs(solid.normal(face)[face.mark]), 1.0);
    }
    const Polyhedron block(solid.mesh(piece));
    EXPECT_EQ(block.mesh().points.size(), 8U);
    EXPECT_EQ(block.faces().size(), 6U);
  }
  // 9 planes of 100 faces for each axis, seen from both sides.
  EXPECT_EQ(shared, 2 * 3 * 9 * 100);
}

TEST(CutSolid, PlanesThatTouchOrMissDoNothing) {
  CutSolid solid(cube(1.0));
  int asked = 0;
  const auto ask = [&](int) {
    ++asked;
    return true;
  };
  // A face, an edge, a corner; and beside the cube.
  solid.cut({Vector3::UnitX(), Vector3::Zero()}, 0, ask);
  solid.cut({Vector3(1, 1, 0), Vector3::Zero()}, 0, ask);
  solid.cut({Vector3(1, 2, 3), Vector3::Ones()}, 0, ask);
  solid.cut({Vector3(1, 2, 3), Vector3::Constant(1.5)}, 0, ask);
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(solid.pieces().size(), 1U);
  EXPECT_EQ(solid.volume(0), 1.0);
}

// The planes x = y, y = z and x = z share the diagonal: six tetrahedra of 1/6.
TEST(CutSolid, ThreePlanesThroughOneLine) {
  CutSolid solid(cube(1.0));
  solid.cut({Vector3(1, -1, 0), Vector3::Zero()}, 0, always);
  solid.cut({Vector3(0, 1, -1), Vector3::Zero()}, 1, always);
  solid.cut({Vector3(1, 0, -1), Vector3::Zero()}, 2, always);
  const std::vector<int> pieces = solid.pieces();
  ASSERT_EQ(pieces.size(), 6U);
  for (const int piece : pieces) {
    EXPECT_EQ(solid.volume(piece), 1.0 / 6.0);
    const Polyhedron block(solid.mesh(piece));
    EXPECT_EQ(block.corners().size(), 4U);
  }
}

TEST(CutSolid, SlabsOfABillionthOfTheCube) {
  CutSolid solid(cube(10.0));
  const Vector3 normal = plane_normal(90.0, 90.0);
  EXPECT_EQ(normal, Vector3::UnitX());
  for (const double offset : {0.0, 1e-8, 2e-8})
    solid.cut({normal, Vector3::Constant(5.0), offset}, 0, always);
  const std::vector<int> pieces = solid.pieces();
  ASSERT_EQ(pieces.size(), 4U);
  // The doubles 1e-8 and 2e-8 are exact offsets.
  EXPECT_EQ(solid.volume(pieces[1]), 1e-8 * 100.0);
  EXPECT_EQ(solid.volume(pieces[0]), 500.0);
  EXPECT_NEAR(solid.volume(pieces[2]), 1e-6, 1e-21);
  for (const int piece : pieces) EXPECT_EQ(resolved(solid.mesh(piece)).faces().size(), 6U);
}

Vector3 random_normal(std::mt19937_64& random) {
  std::normal_distribution<double> part;
  return Vector3(part(random), part(random), part(random)).normalized();
}

// Neighbours have the same corners on common faces, no two pieces overlap, and volumes add up.
TEST(CutSolid, RandomSetsConserve) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 5; ++round) {
    CutSolid solid(cube(10.0));
    for (int set = 0; set < 3 + round % 4; ++set) {
      const Vector3 normal = random_normal(random);
      for (int k = -3; k <= 3; ++k) solid.cut({normal, Vector3::Constant(5.0), 1.9 * k}, set, always);
    }
    EXPECT_NEAR(total_volume(solid), 1000.0, 1e-9);
    std::map<std::pair<int, int>, double> areas;
    double surface = 0.0;
    std::vector<ConvexShape> shapes;
    for (const int piece : solid.pieces()) {
      for (const PieceFace& face : solid.faces(piece)) {
        if (face.neighbour < 0)
          surface += solid.area(face);
        else
          areas[{piece, face.neighbour}] += solid.area(face);
      }
      const Polyhedron block = resolved(solid.mesh(piece));
      EXPECT_TRUE(block.convex());
      EXPECT_NEAR(block.volume(), solid.volume(piece), 1e-12 * 100.0);
    }
    EXPECT_NEAR(surface, 600.0, 1e-9);
    for (const auto& [pair, area] : areas) EXPECT_EQ((areas.at({pair.second, pair.first})), area);
  }
}

}  // namespace
}  // namespace ashlar

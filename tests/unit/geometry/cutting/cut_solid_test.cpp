#include "geometry/cutting/cut_solid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "geometry/solid/shapes.hpp"

namespace ashlar::cut_solid_test {
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

/// An L of three unit cubes: at the origin, beside it along x and along y.
Polyhedron angle() {
  TriangleMesh mesh;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] :
         std::initializer_list<std::pair<double, double>>{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})
      mesh.points.emplace_back(x, y, z);
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, next + 6});
    mesh.triangles.push_back({k, next + 6, k + 6});
  }
  for (const auto& [a, b, c] :
       std::initializer_list<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
  }
  return Polyhedron(std::move(mesh));
}

TEST(CutSolid, NonConvexSolidIsOnePieceUntilCut) {
  CutSolid solid(angle());
  ASSERT_EQ(solid.pieces().size(), 1U);
  EXPECT_EQ(solid.volume(0), 3.0);
  EXPECT_EQ(Polyhedron(solid.mesh(0)).faces().size(), 8U);
  // x + y = 2 goes through the reflex corner and cuts the two arms apart from the corner: two triangles.
  solid.cut({Vector3(1, 1, 0), Vector3(2, 0, 0)}, 0, always);
  std::vector<double> volumes;
  for (const int piece : solid.pieces()) volumes.push_back(solid.volume(piece));
  EXPECT_EQ(volumes, (std::vector<double>{2.0, 0.5, 0.5}));
}

// A plane along a face inside the decomposition must part the arms there too.
TEST(CutSolid, PlaneAlongAnInnerFaceParts) {
  CutSolid solid(angle());
  solid.cut({Vector3::UnitX(), Vector3(1, 0, 0)}, 3, always);
  ASSERT_EQ(solid.pieces().size(), 2U);
  for (const int piece : solid.pieces()) {
    int shared = 0;
    for (const PieceFace& face : solid.faces(piece)) {
      if (face.neighbour < 0) continue;
      ++shared;
      EXPECT_EQ(face.mark, 3);
      EXPECT_EQ(solid.area(face), 1.0);
    }
    EXPECT_EQ(shared, 1);
  }
}

// A plate with a wall around a tower that is hollow: the section has two outer loops, one within the hole of the other,
// and each hole belongs to the loop next around it.
TEST(CutSolid, SectionsMayHaveLoopsWithinHoles) {
  CutSolid block(cube(9.0));
  int around = 0;
  for (const int rim : {1, 3, 4}) {
    const Polyhedron pit(make_box(Vector3(rim, rim, 1), Vector3(9 - rim, 9 - rim, 10)));
    block.cut_along(pit, 0, rim, [&](int piece) { return block.label(piece) == around; });
    around = rim;
  }
  // Plate and wall, the gap between wall and tower, the tower, and its inside.
  std::map<int, int> by_label;
  for (const int piece : block.pieces()) by_label[block.label(piece)] = piece;
  ASSERT_EQ(by_label.size(), 4U);
  EXPECT_EQ(block.volume(by_label[0]), 81.0 + 8.0 * (81 - 49));
  EXPECT_EQ(block.volume(by_label[3]), 8.0 * (9 - 1));
  block.glue(by_label[3], by_label[0]);

  CutSolid solid{Polyhedron(block.mesh(by_label[0]))};
  solid.cut({Vector3::UnitZ(), Vector3(0, 0, 5)}, 7, always);
  const std::vector<int> pieces = solid.pieces();
  ASSERT_EQ(pieces.size(), 3U);
  std::vector<double> volumes, areas;
  for (const int piece : pieces) {
    volumes.push_back(solid.volume(piece));
    EXPECT_EQ(Polyhedron(solid.mesh(piece)).volume(), solid.volume(piece));
    for (const PieceFace& face : solid.faces(piece))
      if (face.mark == 7) areas.push_back(solid.area(face));
  }
  std::sort(volumes.begin(), volumes.end());
  std::sort(areas.begin(), areas.end());
  EXPECT_EQ(volumes, (std::vector<double>{4.0 * 8, 4.0 * 32, 81.0 + 4.0 * 8 + 4.0 * 32}));
  EXPECT_EQ(areas, (std::vector<double>{8, 8, 32, 32}));
}

TEST(CutSolid, AlongABoxLeavesAHole) {
  CutSolid solid(cube(4.0));
  const Polyhedron tunnel(make_box({1, -1, 1}, {2, 5, 3}));
  solid.cut_along(tunnel, 0, 1, always);
  const std::vector<int> pieces = solid.pieces();
  ASSERT_EQ(pieces.size(), 2U);
  double inside = 0.0, outside = 0.0;
  for (const int piece : pieces) (solid.label(piece) == 1 ? inside : outside) += solid.volume(piece);
  EXPECT_EQ(inside, 1.0 * 4.0 * 2.0);
  EXPECT_EQ(outside, 64.0 - 8.0);
  for (const int piece : pieces) {
    const Polyhedron body(solid.mesh(piece));
    EXPECT_EQ(body.volume(), solid.volume(piece));
    EXPECT_EQ(body.faces().size(), solid.label(piece) == 1 ? 6U : 10U);
  }
  // A joint then cuts both.
  solid.cut({Vector3::UnitZ(), Vector3(0, 0, 2)}, 1, always);
  EXPECT_EQ(solid.pieces().size(), 4U);
  EXPECT_EQ(total_volume(solid), 64.0);
}

TEST(CutSolid, ChoiceLeavesPiecesWholeAndFacesFit) {
  CutSolid solid(cube(2.0));
  solid.cut({Vector3::UnitX(), Vector3::Ones()}, 0, always);
  const int left = solid.pieces().front();
  solid.cut({Vector3::UnitZ(), Vector3::Ones()}, 1, [&](int piece) { return piece == left; });
  const std::vector<int> pieces = solid.pieces();
  ASSERT_EQ(pieces.size(), 3U);
  const int right = pieces.back();
  EXPECT_EQ(solid.volume(right), 4.0);
  // The whole half has two neighbours of half its face each, and is still a box.
  double shared = 0.0;
  for (const PieceFace& face : solid.faces(right))
    if (face.neighbour >= 0) shared += solid.area(face);
  EXPECT_EQ(shared, 4.0);
  EXPECT_EQ(solid.mesh(right).points.size(), 8U);
}

// Measures midway between two doubles: only exact arithmetic detects the tie, which goes to the even one.
TEST(CutSolid, MeasuresBetweenTwoNumbersAreRoundedToTheEvenOne) {
  constexpr double x = 1 + 0x1p-26;
  const auto measure = [&](double y) {
    const CutSolid solid(Polyhedron(make_box({0, 0, 0}, {x, y, 1})));
    double area = 0.0;
    for (const PieceFace& face : solid.faces(0))
      if (solid.normal(face).z() == 1.0) area = solid.area(face);
    EXPECT_EQ(area, solid.volume(0));
    return area;
  };
  EXPECT_EQ(measure(1 + 0x1p-27), 1 + 0x1p-26 + 0x1p-27) << "and 2^-53";
  EXPECT_EQ(measure(1 + 0x3p-27), 1 + 0x1p-26 + 0x3p-27 + 0x1p-51) << "and 3 2^-53";
}

// The upper half of a box on its lower half.
TEST(CutSolid, APieceIsAKeyBlockByTheFacesThatHoldIt) {
  CutSolid solid(cube(2.0));
  solid.cut({Vector3::UnitZ(), Vector3::Ones()}, 0, always);
  for (const int piece : solid.pieces()) {
    std::vector<HeldFace> held;
    double outward = 0.0;
    for (const PieceFace& face : solid.faces(piece)) {
      if (face.neighbour < 0) continue;
      held.push_back({face.plane, face.below});
      outward = solid.normal(face).z();
    }
    ASSERT_EQ(held.size(), 1U);
    const Vector3 against(0, 0, outward);
    const KeyBlock pressed = solid.key_block(piece, held, against);
    EXPECT_TRUE(pressed.finite);
    EXPECT_TRUE(pressed.removable);
    EXPECT_EQ(pressed.mode, BlockMode::stable);
    const KeyBlock pulled = solid.key_block(piece, held, -against);
    EXPECT_EQ(pulled.mode, BlockMode::falling);
    EXPECT_EQ(pulled.direction, -against);
  }
}

TEST(CutSolid, DiscMeetsWhatIsWithinItsRadius) {
  CutSolid solid(cube(2.0));
  const CutPlane plane{Vector3::UnitZ(), Vector3(3, 1, 1)};
  EXPECT_EQ(solid.distance_in_plane(0, plane), 1.0);
  EXPECT_EQ(solid.distance_in_plane(0, {Vector3::UnitZ(), Vector3::Ones()}), 0.0);
  EXPECT_EQ(solid.distance_in_plane(0, {Vector3::UnitZ(), Vector3(1, 1, 5)}),
            std::numeric_limits<double>::infinity());
  // In the notch of an L, half way between its two faces, and within one of its arms.
  const CutSolid notched(angle());
  EXPECT_EQ(notched.distance_in_plane(0, {Vector3::UnitZ(), Vector3(1.5, 1.75, 0.5)}), 0.5);
  EXPECT_EQ(notched.distance_in_plane(0, {Vector3::UnitZ(), Vector3(0.5, 1.75, 0.5)}), 0.0);
}

// Eight points at the corners of a cube within the cube: its octants.
TEST(CutSolid, VoronoiCellsOfALatticeAreCubes) {
  CutSolid solid(cube(2.0));
  std::vector<Vector3> points;
  for (int k = 0; k < 8; ++k) points.emplace_back(0.5 + k % 2, 0.5 + k / 2 % 2, 0.5 + k / 4);
  solid.cut_into_cells(points, 0);
  const std::vector<int> pieces = solid.pieces();
  ASSERT_EQ(pieces.size(), 8U);
  for (const int piece : pieces) {
    EXPECT_EQ(solid.volume(piece), 1.0);
    int neighbours = 0;
    for (const PieceFace& face : solid.faces(piece)) neighbours += face.neighbour >= 0 ? 1 : 0;
    EXPECT_EQ(neighbours, 3);
  }
  EXPECT_THROW(solid.cut_into_cells(points, 0), CutError);
}

TEST(CutSolid, VoronoiCellsHoldTheirPointsAndFit) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(0.0, 3.0);
  std::vector<Vector3> points;
  for (int k = 0; k < 60; ++k) {
    Vector3 point;
    for (double& x : point) x = place(random);
    points.push_back(point);
  }
  CutSolid solid(cube(3.0));
  solid.cut_into_cells(points, 0);
  const std::vector<int> pieces = solid.pieces();
  ASSERT_EQ(pieces.size(), points.size());
  EXPECT_NEAR(total_volume(solid), 27.0, 1e-12);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    for (const PieceFace& face : solid.faces(pieces[k])) {
      const Vector3 normal = solid.normal(face);
      EXPECT_GT(solid.extent(pieces[k], {normal, points[k]}).second, 0.0);
      EXPECT_TRUE(face.neighbour >= 0 || face.mark < 0) << "cut faces are shared";
    }
  }
  solid.cut({plane_normal(40, 70), Vector3::Constant(1.5)}, 1, always);
  EXPECT_NEAR(total_volume(solid), 27.0, 1e-12);
  points.push_back(points.front());
  CutSolid other(cube(3.0));
  EXPECT_THROW(other.cut_into_cells(points, 0), CutError);
}

}  // namespace
}  // namespace ashlar::cut_solid_test

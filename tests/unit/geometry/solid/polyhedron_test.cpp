#include "geometry/solid/polyhedron.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/solid/shapes.hpp"
#include "support/sample_meshes.hpp"
#include "unit/geometry/solid/expect_consistent.hpp"

namespace ashlar::polyhedron_test {
namespace {

using test_support::expect_consistent;
using test_support::make_divided_cube;
using test_support::make_frame;
using test_support::make_l_prism;
using test_support::make_pyramid;
using testing::ElementsAre;
using testing::SizeIs;

std::size_t count_convex_edges(const Polyhedron& p) {
  return std::count_if(p.edges().begin(), p.edges().end(), [](const auto& e) { return e.convex; });
}

std::size_t count_convex_faces(const Polyhedron& p) {
  return std::count_if(p.faces().begin(), p.faces().end(), [](const auto& f) { return f.convex; });
}

const PolyhedronFace& face_with_normal(const Polyhedron& p, const Vector3& normal) {
  return *std::find_if(p.faces().begin(), p.faces().end(), [&](const auto& f) { return f.normal == normal; });
}

bool contains(const std::vector<int>& loop, int v) {
  return std::find(loop.begin(), loop.end(), v) != loop.end();
}

TEST(Polyhedron, box) {
  const Polyhedron p(make_box({0, 0, 0}, {1, 2, 3}));
  expect_consistent(p);
  EXPECT_EQ(p.volume(), 6.0);
  EXPECT_TRUE(p.convex());
  EXPECT_THAT(p.faces(), SizeIs(6));
  EXPECT_THAT(p.edges(), SizeIs(12));
  EXPECT_THAT(p.corners(), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_EQ(count_convex_faces(p), 6U);
  EXPECT_EQ(count_convex_edges(p), 12U);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const PolyhedronFace& face = face_with_normal(p, side * Vector3::Unit(axis));
      EXPECT_THAT(face.triangles, SizeIs(2));
      EXPECT_THAT(face.loops, ElementsAre(SizeIs(4)));
    }
  }
}

TEST(Polyhedron, loop_of_a_face_runs_counter_clockwise_from_outside) {
  const Polyhedron p(make_box({0, 0, 0}, {1, 1, 1}));
  for (const PolyhedronFace& face : p.faces()) {
    const auto& points = p.mesh().points;
    const auto& loop = face.loops[0];
    const Vector3 turn = (points[loop[1]] - points[loop[0]]).cross(points[loop[2]] - points[loop[1]]);
    EXPECT_EQ(turn, face.normal);
  }
}

TEST(Polyhedron, l_prism_has_one_reflex_edge) {
  const Polyhedron p(make_l_prism());
  expect_consistent(p);
  EXPECT_EQ(p.volume(), 3.0);
  EXPECT_FALSE(p.convex());
  EXPECT_THAT(p.faces(), SizeIs(8));
  EXPECT_THAT(p.edges(), SizeIs(18));
  EXPECT_THAT(p.corners(), SizeIs(12));
  EXPECT_EQ(count_convex_faces(p), 6U);
  ASSERT_EQ(count_convex_edges(p), 17U);
  const auto reflex =
      std::find_if(p.edges().begin(), p.edges().end(), [](const auto& e) { return !e.convex; });
  EXPECT_EQ(std::set<int>(reflex->vertices.begin(), reflex->vertices.end()), (std::set<int>{3, 9}));
}

TEST(Polyhedron, frame_has_faces_with_a_hole) {
  const Polyhedron p(make_frame());
  expect_consistent(p);
  EXPECT_EQ(p.volume(), 8.0);
  EXPECT_FALSE(p.convex());
  EXPECT_THAT(p.faces(), SizeIs(10));
  EXPECT_THAT(p.edges(), SizeIs(24));
  EXPECT_THAT(p.corners(), SizeIs(16));
  EXPECT_EQ(count_convex_edges(p), 20U);
  EXPECT_EQ(count_convex_faces(p), 8U);
  const PolyhedronFace& top = face_with_normal(p, {0, 0, 1});
  ASSERT_THAT(top.loops, SizeIs(2));
  EXPECT_TRUE(contains(top.loops[0], 8));
  EXPECT_TRUE(contains(top.loops[1], 12));
}

TEST(Polyhedron, pyramid) {
  const Polyhedron p(make_pyramid());
  expect_consistent(p);
  EXPECT_EQ(p.volume(), 4.0);
  EXPECT_TRUE(p.convex());
  EXPECT_THAT(p.faces(), SizeIs(5));
  EXPECT_THAT(p.edges(), SizeIs(8));
  EXPECT_THAT(p.corners(), SizeIs(5));
  const double length = std::sqrt(10.0);  // the side face over y = 0 rises 3 over 1
  const auto& faces = p.faces();
  EXPECT_TRUE(std::any_of(faces.begin(), faces.end(), [length](const auto& f) {
    return (f.normal - Vector3(0, -3 / length, 1 / length)).norm() < 1e-15;
  }));
}

TEST(Polyhedron, points_inside_faces_and_sides_are_no_corners) {
  for (const int n : {2, 3, 5}) {
    const Polyhedron p(make_divided_cube(n));
    expect_consistent(p);
    EXPECT_TRUE(p.convex());
    EXPECT_THAT(p.faces(), SizeIs(6));
    EXPECT_THAT(p.edges(), SizeIs(12));
    EXPECT_THAT(p.corners(), SizeIs(8));
    for (const PolyhedronFace& face : p.faces()) {
      EXPECT_THAT(face.triangles, SizeIs(2 * n * n));
      EXPECT_THAT(face.loops, ElementsAre(SizeIs(4)));
      EXPECT_TRUE(face.convex);
    }
  }
}

TEST(Polyhedron, tilted_cube_with_exact_coordinates_has_flat_faces) {
  TriangleMesh mesh = make_box({0, 0, 0}, {1, 1, 1});
  for (Vector3& p : mesh.points) p = Vector3(3 * p.x() - 4 * p.y(), 4 * p.x() + 3 * p.y(), 5 * p.z());
  const Polyhedron p(mesh);
  expect_consistent(p);
  EXPECT_EQ(p.volume(), 125.0);
  EXPECT_TRUE(p.convex());
  EXPECT_THAT(p.faces(), SizeIs(6));
  EXPECT_NEAR((face_with_normal(p, Vector3(0.6, 0.8, 0)).normal - Vector3(0.6, 0.8, 0)).norm(), 0.0, 1e-16);
}

// The top face of the box is cut along 4-7. One ulp at 7 makes it a roof, one ulp at 5 a valley.
TEST(Polyhedron, one_ulp_decides_about_flat_convex_and_reflex) {
  const double up = std::nextafter(1.0, 2.0);
  TriangleMesh roof = make_box({0, 0, 0}, {1, 1, 1});
  roof.points[7].z() = up;
  const Polyhedron convex(roof);
  expect_consistent(convex);
  EXPECT_THAT(convex.faces(), SizeIs(7));
  EXPECT_THAT(convex.edges(), SizeIs(13));
  EXPECT_TRUE(convex.convex());

  TriangleMesh valley = make_box({0, 0, 0}, {1, 1, 1});
  valley.points[5].z() = up;
  const Polyhedron reflex(valley);
  EXPECT_THAT(reflex.faces(), SizeIs(7));
  EXPECT_EQ(count_convex_edges(reflex), 12U);
  EXPECT_FALSE(reflex.convex());
}

// Box [0,1]^3 and beside it a prism over the trapezoid (0,0) (1,0) (1,1) (-1,1) in (y,z): the side y = 0 of
// the bottom face has a wall up to x = 1 and an overhang from there, so its middle point is a straight
// corner.
TEST(Polyhedron, corner_in_a_straight_side_stays_where_the_neighbour_changes) {
  const Polyhedron p({{{0, 0, 0},
                       {0, 1, 0},
                       {0, 1, 1},
                       {0, 0, 1},
                       {2, 0, 0},
                       {2, 1, 0},
                       {2, 1, 1},
                       {2, -1, 1},
                       {1, 0, 0},
                       {1, 0, 1},
                       {1, -1, 1}},
                      {{0, 1, 8},
                       {1, 5, 8},
                       {5, 4, 8},
                       {3, 9, 2},
                       {9, 6, 2},
                       {9, 10, 6},
                       {10, 7, 6},
                       {1, 2, 6},
                       {1, 6, 5},
                       {0, 3, 2},
                       {0, 2, 1},
                       {4, 5, 6},
                       {4, 6, 7},
                       {0, 8, 9},
                       {0, 9, 3},
                       {8, 4, 7},
                       {8, 7, 10},
                       {8, 10, 9}}});
  expect_consistent(p);
  EXPECT_EQ(p.volume(), 2.5);
  EXPECT_THAT(p.faces(), SizeIs(8));
  EXPECT_THAT(p.edges(), SizeIs(17));
  EXPECT_THAT(p.corners(), SizeIs(11));
  const PolyhedronFace& bottom = face_with_normal(p, {0, 0, -1});
  EXPECT_THAT(bottom.loops, ElementsAre(SizeIs(5)));
  EXPECT_TRUE(bottom.convex);
  EXPECT_FALSE(face_with_normal(p, {0, 0, 1}).convex);
}

// Box 2 x 2 x 1 with a pit in its top, the tetrahedron A B C D of volume 1/6; A is a corner of the box.
TEST(Polyhedron, hole_touching_the_outer_loop_is_a_loop_of_its_own) {
  const Polyhedron p({{{0, 0, 0},
                       {2, 0, 0},
                       {2, 2, 0},
                       {0, 2, 0},
                       {0, 0, 1},
                       {2, 0, 1},
                       {2, 2, 1},
                       {0, 2, 1},
                       {1.5, 0.5, 1},
                       {0.5, 1.5, 1},
                       {0.625, 0.625, 0.5}},
                      {{0, 2, 1},
                       {0, 3, 2},
                       {0, 1, 5},
                       {0, 5, 4},
                       {1, 2, 6},
                       {1, 6, 5},
                       {2, 3, 7},
                       {2, 7, 6},
                       {3, 0, 4},
                       {3, 4, 7},
                       {4, 5, 8},
                       {5, 6, 8},
                       {8, 6, 9},
                       {6, 7, 9},
                       {7, 4, 9},
                       {4, 8, 10},
                       {8, 9, 10},
                       {9, 4, 10}}});
  expect_consistent(p);
  EXPECT_EQ(p.volume(), 23.0 / 6.0);
  EXPECT_THAT(p.faces(), SizeIs(9));
  const PolyhedronFace& top = face_with_normal(p, {0, 0, 1});
  ASSERT_THAT(top.loops, SizeIs(2));
  EXPECT_THAT(top.loops[0], testing::UnorderedElementsAre(4, 5, 6, 7));
  EXPECT_THAT(top.loops[1], testing::UnorderedElementsAre(4, 8, 9));
  EXPECT_FALSE(top.convex);
}

// Box 2 x 2 x 1, its top cut into four triangles at the middle; low pyramids of volume 1/3 stand on two of
// them.
TEST(Polyhedron, coplanar_faces_touching_in_a_point_stay_two) {
  const Polyhedron p({{{0, 0, 0},
                       {2, 0, 0},
                       {2, 2, 0},
                       {0, 2, 0},
                       {0, 0, 1},
                       {2, 0, 1},
                       {2, 2, 1},
                       {0, 2, 1},
                       {1, 1, 1},
                       {0.25, 1, 2},
                       {1.75, 1, 2}},
                      {{0, 2, 1},
                       {0, 3, 2},
                       {0, 1, 5},
                       {0, 5, 4},
                       {1, 2, 6},
                       {1, 6, 5},
                       {2, 3, 7},
                       {2, 7, 6},
                       {3, 0, 4},
                       {3, 4, 7},
                       {4, 5, 8},
                       {6, 7, 8},
                       {7, 4, 9},
                       {4, 8, 9},
                       {8, 7, 9},
                       {5, 6, 10},
                       {6, 8, 10},
                       {8, 5, 10}}});
  expect_consistent(p);
  EXPECT_EQ(p.volume(), 14.0 / 3.0);
  EXPECT_THAT(p.faces(), SizeIs(13));
  EXPECT_THAT(p.edges(), SizeIs(22));
  EXPECT_EQ(
      std::count_if(p.faces().begin(), p.faces().end(), [](const auto& f) { return f.normal.z() == 1.0; }),
      2);
}

// 0.1, 0.2 and 0.3 as doubles; the exact product, 0.0060000000000000001998..., rounded by rational
// arithmetic, is one ulp below what rounding after every multiplication gives.
TEST(Polyhedron, volume_is_correctly_rounded) {
  const Polyhedron p(make_box({0, 0, 0}, {0.1, 0.2, 0.3}));
  EXPECT_EQ(p.volume(), 0.006);
  // Far from the origin the terms are 1e24 times the result.
  const Polyhedron far(make_box({1e8, 1e8, 1e8}, {1e8 + 1, 1e8 + 1, 1e8 + 1}));
  EXPECT_EQ(far.volume(), 1.0);
  const double tiny = std::ldexp(1.0, -357);
  EXPECT_EQ(Polyhedron(make_box({0, 0, 0}, {tiny, tiny, 3 * tiny})).volume(), std::ldexp(3.0, -1071));
}

TEST(Polyhedron, refused_mesh_carries_all_its_defects) {
  TriangleMesh mesh = make_pyramid();
  mesh.points.emplace_back(9, 9, 9);
  mesh.triangles.pop_back();
  try {
    const Polyhedron p(mesh);
    FAIL() << "an open mesh was accepted";
  } catch (const MeshError& error) {
    EXPECT_THAT(error.defects(), SizeIs(4));
    EXPECT_STREQ(error.what(), "unused vertex: point 5 and 3 more");
  }
}

}  // namespace
}  // namespace ashlar::polyhedron_test

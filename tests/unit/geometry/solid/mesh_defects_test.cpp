#include "geometry/solid/mesh_defects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "geometry/solid/polyhedron.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar::mesh_defects_test {
namespace {

using test_support::join;
using test_support::make_dented_cube;
using test_support::make_prism;
using test_support::make_pyramid;
using test_support::turned_inside_out;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

TriangleMesh unit_cube() {
  return make_box({0, 0, 0}, {1, 1, 1});
}

std::vector<std::string> found(const TriangleMesh& mesh, std::size_t limit = 10) {
  std::vector<std::string> lines;
  for (const MeshDefect& d : Polyhedron::find_defects(mesh, limit))
    lines.push_back(to_string(d.kind) + ": " + d.element);
  return lines;
}

TEST(MeshDefects, sound_meshes_have_none) {
  EXPECT_THAT(found(unit_cube()), IsEmpty());
  EXPECT_THAT(found(test_support::make_l_prism()), IsEmpty());
  EXPECT_THAT(found(test_support::make_frame()), IsEmpty());
  EXPECT_THAT(found(test_support::make_divided_cube(4)), IsEmpty());
  EXPECT_THAT(found(make_dented_cube(0.25)), IsEmpty());
}

TEST(MeshDefects, empty) {
  EXPECT_THAT(found({}), ElementsAre("empty mesh: 0 points, 0 triangles"));
  EXPECT_THAT(found({{{0, 0, 0}}, {}}), ElementsAre("empty mesh: 1 points, 0 triangles"));
}

TEST(MeshDefects, non_finite_point) {
  TriangleMesh mesh = unit_cube();
  mesh.points[3].y() = std::numeric_limits<double>::quiet_NaN();
  mesh.points[5].z() = -std::numeric_limits<double>::infinity();
  EXPECT_THAT(found(mesh),
              ElementsAre("non-finite point: point 3 (1, nan, 0)", "non-finite point: point 5 (1, 0, -inf)"));
}

TEST(MeshDefects, index_out_of_range) {
  TriangleMesh mesh = unit_cube();
  mesh.triangles[2][1] = 8;
  mesh.triangles[4] = {-1, 900, 2};
  EXPECT_THAT(found(mesh), ElementsAre("index out of range: triangle 2 (point 8, allowed 0 to 7)",
                                       "index out of range: triangle 4 (point -1, allowed 0 to 7)"));
}

TEST(MeshDefects, repeated_index) {
  TriangleMesh mesh = unit_cube();
  mesh.triangles.push_back({2, 2, 5});
  EXPECT_THAT(found(mesh), ElementsAre("zero-area triangle: triangle 12 (points 2, 2, 5)"));
}

// A point on the edge 0-4 of the pyramid joined by a triangle without area instead of a division: the
// triangles on both sides of it meet along parts of their sides.
TEST(MeshDefects, collinear_triangle) {
  TriangleMesh mesh = make_pyramid();
  mesh.points.emplace_back(0.5, 0.5, 1.5);
  mesh.triangles.back() = {3, 0, 5};
  mesh.triangles.push_back({3, 5, 4});
  mesh.triangles.push_back({0, 4, 5});
  EXPECT_THAT(found(mesh),
              ElementsAre("zero-area triangle: triangle 7 (points 0, 4, 5)",
                          "self-intersection: triangles 2, 5", "self-intersection: triangles 2, 6"));
}

TEST(MeshDefects, open_edge) {
  TriangleMesh mesh = make_pyramid();
  mesh.triangles.pop_back();  // 3 0 4
  EXPECT_THAT(found(mesh),
              ElementsAre("open edge: edge 0-3 of triangle 1", "open edge: edge 0-4 of triangle 2",
                          "open edge: edge 3-4 of triangle 4"));
}

TEST(MeshDefects, non_manifold_edge) {
  TriangleMesh mesh = make_pyramid();
  mesh.points.emplace_back(-5, -5, 0);
  mesh.triangles.push_back({0, 4, 5});  // a fin
  EXPECT_THAT(found(mesh),
              ElementsAre("non-manifold edge: edge 0-4 of triangles 2, 5, 6",
                          "open edge: edge 0-5 of triangle 6", "open edge: edge 4-5 of triangle 6"));
}

TEST(MeshDefects, inconsistent_edge) {
  TriangleMesh mesh = make_pyramid();
  std::swap(mesh.triangles[5][1], mesh.triangles[5][2]);
  EXPECT_THAT(found(mesh), ElementsAre("inconsistently oriented edge: edge 0-3 of triangles 1, 5",
                                       "inconsistently oriented edge: edge 0-4 of triangles 2, 5",
                                       "inconsistently oriented edge: edge 3-4 of triangles 4, 5"));
}

// Two pyramids, apex to apex, with the apex in common.
TEST(MeshDefects, non_manifold_vertex) {
  TriangleMesh mesh = join(make_pyramid(), make_pyramid());
  for (std::size_t i = 5; i < 10; ++i) mesh.points[i].z() = 6.0 - mesh.points[i].z();
  for (std::size_t t = 6; t < 12; ++t) {
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    for (int& v : mesh.triangles[t]) v = v == 9 ? 4 : v;
  }
  mesh.points.pop_back();
  EXPECT_THAT(found(mesh), ElementsAre("non-manifold vertex: point 4",
                                       "several components: triangle 6 (not connected to triangle 0)"));
}

TEST(MeshDefects, fused_vertices) {
  TriangleMesh mesh = make_pyramid();
  mesh.points.push_back(mesh.points[4]);
  mesh.triangles[5][2] = 5;
  EXPECT_THAT(found(mesh), Contains("fused vertices: points 4, 5"));
  EXPECT_THAT(found(mesh), Contains("open edge: edge 0-5 of triangle 5"));
  EXPECT_THAT(found(mesh), SizeIs(5));
}

TEST(MeshDefects, positive_and_negative_zero_are_equal) {
  TriangleMesh mesh = unit_cube();
  mesh.points.emplace_back(-0.0, 0.0, -0.0);
  EXPECT_THAT(found(mesh), UnorderedElementsAre("unused vertex: point 8", "fused vertices: points 0, 8"));
}

TEST(MeshDefects, unused_vertex) {
  TriangleMesh mesh = unit_cube();
  mesh.points.emplace_back(7, 7, 7);
  EXPECT_THAT(found(mesh), ElementsAre("unused vertex: point 8"));
}

TEST(MeshDefects, surfaces_crossing) {
  const std::vector<std::string> lines = found(make_dented_cube(-0.25));
  EXPECT_FALSE(lines.empty());
  EXPECT_THAT(lines, testing::Each(testing::StartsWith("self-intersection: triangles ")));
}

// The point of the dent touches the bottom, which is cut along 0-3 into triangles 0 and 1.
TEST(MeshDefects, point_touching_a_face) {
  EXPECT_THAT(found(make_dented_cube(0.0)), SizeIs(8));
  EXPECT_THAT(found(make_dented_cube(0.0)), Contains("self-intersection: triangles 0, 10"));
  EXPECT_THAT(found(make_dented_cube(std::nextafter(0.0, 1.0))), IsEmpty());
}

// A pyramid with its apex moved into the plane of the base: neighbours over base edges lie on each other.
TEST(MeshDefects, neighbours_lying_on_each_other) {
  TriangleMesh mesh = make_pyramid();
  mesh.points[4] = {1.0, 0.5, 0.0};
  const std::vector<std::string> lines = found(mesh);
  EXPECT_THAT(lines, Contains("self-intersection: triangles 0, 2"));
  EXPECT_THAT(lines, Contains(testing::StartsWith("zero volume: ")));
}

// Profile with a slit: sides 2-3 and 3-4 run along each other, so two walls coincide.
TEST(MeshDefects, slit) {
  const TriangleMesh mesh =
      make_prism({{0, 0}, {4, 0}, {4, 4}, {2, 2}, {3, 3}, {0, 4}},
                 {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}, {{0, 1, 2, 3, 4, 5}}, 1.0);
  EXPECT_THAT(found(mesh), Contains(testing::StartsWith("self-intersection: ")));
}

TEST(MeshDefects, several_components) {
  const TriangleMesh apart = join(unit_cube(), make_box({3, 3, 3}, {4, 4, 4}));
  EXPECT_THAT(found(apart), ElementsAre("several components: triangle 12 (not connected to triangle 0)"));
  const TriangleMesh shell =
      join(unit_cube(), turned_inside_out(make_box({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5})));
  EXPECT_THAT(found(shell), ElementsAre("several components: triangle 12 (not connected to triangle 0)"));
}

TEST(MeshDefects, inside_out) {
  EXPECT_THAT(found(turned_inside_out(unit_cube())),
              ElementsAre("inside out: surface of triangle 0 (volume -1)"));
  EXPECT_THAT(found(turned_inside_out(test_support::make_frame())),
              ElementsAre("inside out: surface of triangle 0 (volume -8)"));
}

TEST(MeshDefects, zero_volume) {
  const TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_THAT(found(sheet), ElementsAre("self-intersection: triangles 0, 1",
                                        "zero volume: surface of triangle 0 (volume 0)"));
}

TEST(MeshDefects, volume_overflow) {
  EXPECT_THAT(found(make_box({0, 0, 0}, {1e110, 1e110, 1e110})),
              ElementsAre("volume overflow: surface of triangle 0 (volume inf)"));
}

TEST(MeshDefects, list_is_cut_at_the_limit_per_kind) {
  TriangleMesh mesh;
  for (int i = 0; i < 20; ++i)
    mesh = join(mesh, {{{i + 0.0, 0, 0}, {i + 0.5, 0, 0}, {i + 0.0, 1, 0}}, {{0, 1, 2}}});
  EXPECT_THAT(found(mesh, 3), SizeIs(6));  // open edges, several components
  EXPECT_THAT(found(mesh, 7), SizeIs(14));
}

// Winding twice around an axis looks convex at every edge and star-shaped from the middle.
TEST(MeshDefects, double_winding_is_a_self_intersection) {
  TriangleMesh mesh;
  constexpr int n = 10;
  for (int i = 0; i < n; ++i) {
    const double angle = 4.0 * std::acos(-1.0) * i / n;
    // Rising radii keep the points of the second turn apart from those of the first.
    const double radius = 1.0 + 0.01 * i;
    mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
  mesh.points.emplace_back(0, 0, 1);
  mesh.points.emplace_back(0, 0, -1);
  for (int i = 0; i < n; ++i) {
    mesh.triangles.push_back({i, (i + 1) % n, n});
    mesh.triangles.push_back({(i + 1) % n, i, n + 1});
  }
  EXPECT_THAT(found(mesh), Contains(testing::StartsWith("self-intersection: ")));
}

}  // namespace
}  // namespace ashlar::mesh_defects_test

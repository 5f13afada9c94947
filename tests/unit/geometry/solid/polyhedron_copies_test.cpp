// Copies of a solid that is known to be one: its points moved, its faces divided into other triangles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/solid/polyhedron.hpp"
#include "geometry/solid/shapes.hpp"
#include "geometry/subfaces/sub_face_surface.hpp"
#include "support/sample_meshes.hpp"
#include "unit/geometry/solid/expect_consistent.hpp"

namespace ashlar::polyhedron_copies_test {
namespace {

using test_support::expect_consistent;
using test_support::make_divided_cube;
using test_support::make_pyramid;
using testing::SizeIs;

TEST(Polyhedron, moved_copy_keeps_faces_and_updates_measures) {
  const Polyhedron p(make_divided_cube(3));
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  std::vector<Vector3> points = p.mesh().points;
  for (Vector3& q : points) q = 2.0 * Vector3(c * q.x() - s * q.y(), s * q.x() + c * q.y(), q.z());
  const Polyhedron moved = p.with_points(points);
  expect_consistent(moved);
  EXPECT_TRUE(moved.convex());
  EXPECT_THAT(moved.faces(), SizeIs(6));
  EXPECT_NEAR(moved.volume(), 8.0, 1e-13);
  for (std::size_t f = 0; f < 6; ++f) {
    const Vector3& n = p.faces()[f].normal;
    const Vector3 rotated(c * n.x() - s * n.y(), s * n.x() + c * n.y(), n.z());
    EXPECT_LT((moved.faces()[f].normal - rotated).norm(), 1e-14);
  }
}

TEST(Polyhedron, moved_copy_refuses_what_is_no_placement) {
  const Polyhedron p(make_pyramid());
  std::vector<Vector3> points = p.mesh().points;
  EXPECT_THROW((void)p.with_points({points.begin(), points.end() - 1}), std::invalid_argument);
  points[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)p.with_points(points), std::invalid_argument);
  points = p.mesh().points;
  for (Vector3& q : points) q.x() = -q.x();
  EXPECT_THROW((void)p.with_points(points), std::invalid_argument);
}

TEST(Polyhedron, other_triangles_keep_faces_and_edges) {
  // A turned box whose triangles are split: rounding puts the midpoints off the faces.
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Polyhedron box(make_box({0, 0, 0}, {1, 2, 3}));
  std::vector<Vector3> points;
  for (const Vector3& q : box.mesh().points)
    points.emplace_back(c * q.x() - s * q.y(), s * q.x() + c * q.y(), q.z());
  const Polyhedron turned = box.with_points(points);
  const SubFaceSurface surface = divide_surface(turned, 2);
  TriangleMesh mesh;
  mesh.points = surface.points;
  std::vector<int> faces;
  for (const SurfaceCell& cell : surface.cells) {
    mesh.triangles.push_back({cell.corners[0], cell.corners[1], cell.corners[2]});
    faces.push_back(cell.face);
  }
  const Polyhedron divided = turned.with_triangles(mesh, faces);
  EXPECT_THAT(divided.mesh().triangles, SizeIs(12 * 16));
  ASSERT_THAT(divided.faces(), SizeIs(6));
  EXPECT_THAT(divided.edges(), SizeIs(12));
  EXPECT_THAT(divided.corners(), SizeIs(8));
  EXPECT_NEAR(divided.volume(), 6.0, 1e-13);
  for (std::size_t f = 0; f < 6; ++f) {
    EXPECT_EQ(divided.faces()[f].normal, turned.faces()[f].normal);
    EXPECT_THAT(divided.faces()[f].triangles, SizeIs(32));
    ASSERT_THAT(divided.faces()[f].loops, SizeIs(1));
    const auto& loop = divided.faces()[f].loops[0];
    const auto& old_loop = turned.faces()[f].loops[0];
    ASSERT_EQ(loop.size(), old_loop.size());
    for (std::size_t k = 0; k < loop.size(); ++k)
      EXPECT_EQ(divided.mesh().points[static_cast<std::size_t>(loop[k])],
                turned.mesh().points[static_cast<std::size_t>(old_loop[k])]);
  }
  EXPECT_THROW((void)turned.with_triangles(mesh, {}), std::invalid_argument);
  mesh.points[0].x() += 1.0;
  mesh.points[1].x() += 1.0;
  EXPECT_THROW((void)turned.with_triangles(mesh, faces), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::polyhedron_copies_test

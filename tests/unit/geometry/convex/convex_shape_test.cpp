#include "geometry/convex/convex_shape.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <stdexcept>

#include "geometry/solid/shapes.hpp"

namespace ashlar::convex_shape_test {
namespace {

TriangleMesh cube() {
  return make_box(Vector3(0, 0, 0), Vector3(1, 1, 1));
}

// The top of the unit cube as a fan around an inner point, with one point on its edge.
TriangleMesh remeshed_cube() {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) mesh.points.emplace_back(k & 1, k >> 1 & 1, k >> 2 & 1);
  mesh.points.emplace_back(0.25, 0.5, 1.0);  // 8
  mesh.points.emplace_back(0.5, 0.0, 1.0);   // 9
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 9}, {0, 9, 4}, {1, 5, 9}, {2, 6, 7}, {2, 7, 3}, {0, 4, 6},
                    {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {8, 4, 9}, {8, 9, 5}, {8, 5, 7}, {8, 7, 6}, {8, 6, 4}};
  return mesh;
}

TEST(ConvexShape, MergesCoplanarTriangles) {
  for (const TriangleMesh& mesh : {cube(), remeshed_cube()}) {
    const ConvexShape shape = ConvexShape::from_mesh(mesh);
    EXPECT_EQ(shape.corners().size(), 8U);
    EXPECT_EQ(shape.edges().size(), 12U);
    ASSERT_EQ(shape.facet_count(), 6);
    for (int f = 0; f < 6; ++f) EXPECT_EQ(shape.facet(f).size(), 4U);
    for (int v = 0; v < 8; ++v) EXPECT_EQ(shape.facets_of_corner(v).size(), 3U);
    for (const ConvexEdge& e : shape.edges()) EXPECT_NE(e.facets[0], e.facets[1]);
  }
}

TEST(ConvexShape, FindsFeaturesByTheirCorners) {
  const ConvexShape shape = ConvexShape::from_mesh(cube());
  for (int e = 0; e < 12; ++e) {
    const auto [v, w] = shape.edges()[e].corners;
    EXPECT_EQ(shape.find_edge(w, v), e);
  }
  const auto top = shape.facet(3);
  EXPECT_EQ(shape.find_facet(top), 3);
  EXPECT_EQ(shape.find_edge(top[0], top[2]), -1);
}

TEST(ConvexShape, ARotatedCubeIsTheHullOfItsRoundedCorners) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  TriangleMesh mesh = cube();
  for (Vector3& p : mesh.points) p = rotation * p;
  const ConvexShape shape = ConvexShape::from_mesh(mesh);
  EXPECT_EQ(shape.corners().size(), 8U);
  PredicateLadder ladder;
  for (int f = 0; f < shape.facet_count(); ++f) {
    const ContactDirection normal = shape.facet_normal(f);
    for (const Vector3& p : shape.corners())
      EXPECT_LE(sign_along(normal, p, shape.corners()[shape.facet(f)[0]], ladder), 0);
  }
}

TEST(ConvexShape, APlacedSolidWithPointsInItsFacesIsTheHull) {
  const Polyhedron solid(remeshed_cube());
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(1.1, Vector3(3, -1, 2).normalized()).toRotationMatrix();
  std::vector<Vector3> points = solid.mesh().points;
  for (Vector3& p : points) p = rotation * p;
  const ConvexShape shape = ConvexShape::from_polyhedron(solid.with_points(points));
  PredicateLadder ladder;
  for (int f = 0; f < shape.facet_count(); ++f) {
    const ContactDirection normal = shape.facet_normal(f);
    for (const Vector3& p : points)
      EXPECT_LE(sign_along(normal, p, shape.corners()[shape.facet(f)[0]], ladder), 0);
  }
  for (std::size_t v = 0; v < shape.corners().size(); ++v)
    EXPECT_EQ(shape.corners()[v], points[shape.source_points()[v]]);
}

TEST(ConvexShape, RefusesWhatIsNoConvexSolid) {
  TriangleMesh open = cube();
  open.triangles.pop_back();
  EXPECT_THROW((void)ConvexShape::from_mesh(open), std::invalid_argument);
  TriangleMesh dented = remeshed_cube();
  dented.points[8][2] = 0.75;
  EXPECT_THROW((void)ConvexShape::from_mesh(dented), std::invalid_argument);
  TriangleMesh infinite = cube();
  infinite.points[0][0] = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)ConvexShape::from_mesh(infinite), std::invalid_argument);
  EXPECT_THROW((void)ConvexShape::from_triangle(Vector3(0, 0, 0), Vector3(1, 1, 1), Vector3(2, 2, 2)),
               std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::convex_shape_test

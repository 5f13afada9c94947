#include "geometry/solid/face_axes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geometry/solid/shapes.hpp"

namespace ashlar::face_axes_test {
namespace {

TEST(FaceAxes, LieAlongTheLargestFaceAndItsLongestSide) {
  const Polyhedron box(make_box({0, 0, 0}, {1, 2, 3}));
  EXPECT_EQ(surface_area(box.mesh()), 22.0);
  const Eigen::Matrix3d axes = axes_along_largest_face({&box}, 0.0);
  EXPECT_NEAR((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-15);
  EXPECT_NEAR(axes.determinant(), 1.0, 1e-15);
  EXPECT_EQ(std::abs(axes(0, 2)), 1.0) << "normal of the 2 x 3 faces";
  EXPECT_EQ(std::abs(axes(2, 0)), 1.0) << "their sides of 3 m";
}

TEST(FaceAxes, TurnWithTheSolid) {
  const Polyhedron box(make_box({0, 0, 0}, {1, 2, 3}));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  std::vector<Vector3> points;
  for (const Vector3& point : box.mesh().points) points.emplace_back(turn * point);
  const Polyhedron turned(TriangleMesh{points, box.mesh().triangles}, 1e-12);
  EXPECT_NEAR(
      (axes_along_largest_face({&turned}, 1e-9) - turn * axes_along_largest_face({&box}, 1e-9)).norm(), 0.0,
      1e-12);
}

TEST(FaceAxes, TakeTheFirstOfEqualFaces) {
  const Polyhedron first(make_box({0, 0, 0}, {1, 1, 4}));
  const Polyhedron second(make_box({0, 0, 0}, {4 + 1e-12, 1, 1}));
  EXPECT_EQ(axes_along_largest_face({&first, &second}, 1e-9), axes_along_largest_face({&first}, 1e-9));
  EXPECT_EQ(axes_along_largest_face({&first, &second}, 0.0), axes_along_largest_face({&second}, 0.0));
  EXPECT_EQ(axes_along_largest_face({}, 0.0).col(2), Vector3::UnitZ());
}

}  // namespace
}  // namespace ashlar::face_axes_test

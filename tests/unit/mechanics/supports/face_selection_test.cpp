#include "mechanics/supports/face_selection.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "geometry/solid/shapes.hpp"

namespace ashlar::face_selection_test {
namespace {

TEST(FaceSelection, FindsTheFacesInAPlaneFromBothSides) {
  const Polyhedron solid(make_box({0, 0, 0}, {4, 1, 1}));
  const std::vector<int> found = faces_in_plane(solid, {{0, 5, 5}, {-2, 0, 0}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(solid.faces()[static_cast<std::size_t>(found[0])].normal, Vector3(-1, 0, 0));
  EXPECT_EQ(faces_in_plane(solid, {{0, 5, 5}, {1, 0, 0}}), found);
  EXPECT_EQ(faces_in_plane(solid, {{0, 5, 5}, {1e-200, 0, 0}}), found);
  EXPECT_TRUE(faces_in_plane(solid, {{2, 0, 0}, {1, 0, 0}}).empty());
}

TEST(FaceSelection, FindsFacesOfTurnedSolidsDespiteRoundedInput) {
  const Polyhedron box(make_box({0, 0, 0}, {4, 1, 1}));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(std::numbers::pi / 6.0, Vector3::UnitZ()).toRotationMatrix();
  std::vector<Vector3> points;
  for (const Vector3& point : box.mesh().points) points.emplace_back(turn * point);
  // The face x = 4 turns to the plane through (4 cos 30, 4 sin 30) with normal (cos 30, sin 30).
  EXPECT_EQ(faces_in_plane(box.with_points(points), {{3.4641016, 2.0, 0.0}, {0.8660254, 0.5, 0.0}}).size(),
            1U);
}

TEST(FaceSelection, ToleranceIsAMillionthOfTheDiagonal) {
  const Polyhedron solid(make_box({0, 0, 0}, {2, 3, 6}));  // diagonal 7 m
  EXPECT_EQ(faces_in_plane(solid, {{0, 0, 6.9e-6}, {0, 0, 1}}).size(), 1U);
  EXPECT_TRUE(faces_in_plane(solid, {{0, 0, 7.1e-6}, {0, 0, 1}}).empty());
}

TEST(FaceSelection, RefusesAPlaneWithoutDirection) {
  const Polyhedron solid(make_box({0, 0, 0}, {1, 1, 1}));
  EXPECT_THROW((void)faces_in_plane(solid, {{0, 0, 0}, {0, 0, 0}}), std::invalid_argument);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)faces_in_plane(solid, {{0, 0, 0}, {infinity, 0, 0}}), std::invalid_argument);
}

TEST(SurfaceRule, IntegratesOverTheChosenFace) {
  const Polyhedron solid(make_box({0, 0, 0}, {2, 3, 1}));
  const SurfaceRule rule = surface_rule(solid, faces_in_plane(solid, {{0, 0, 1}, {0, 0, 1}}), 2);
  double area = 0.0;
  double second_moment = 0.0;
  for (std::size_t k = 0; k < rule.weights.size(); ++k) {
    area += rule.weights[k];
    second_moment += rule.weights[k] * rule.points[k].x() * rule.points[k].x();
    EXPECT_NEAR(rule.points[k].z(), 1.0, 1e-15);
  }
  EXPECT_NEAR(area, 6.0, 1e-13);
  EXPECT_NEAR(second_moment, 8.0, 1e-13);  // 3 times the integral of x^2 from 0 to 2
}

}  // namespace
}  // namespace ashlar::face_selection_test

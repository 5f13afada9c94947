#include "geometry/solid/shape_loss.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/hull_solid.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar::shape_loss_test {
namespace {

TEST(ShapeLoss, ASolidOfExactCoordinatesIsNeverLost) {
  EXPECT_FALSE(is_lost_in_rounding(Polyhedron(make_box({0, 0, 0}, {1, 1, 1e-300}))));
}

TEST(ShapeLoss, ASolidIsLostWhereItIsThinnerThanTheResolution) {
  const TriangleMesh box = make_box({0, 0, 0}, {1, 1, 0.125});
  EXPECT_FALSE(is_lost_in_rounding(Polyhedron(box, 0x1p-20)));
  EXPECT_TRUE(is_lost_in_rounding(Polyhedron(box, 0.25)));
  EXPECT_TRUE(is_lost_in_rounding(Polyhedron(box, 2.0)));
}

TEST(ShapeLoss, ANeedleIsLostWhereItsFacesCloseUp) {
  const std::vector<Vector3> needle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e14}};
  EXPECT_FALSE(is_lost_in_rounding(make_hull_solid(needle, 0.0)));
  EXPECT_TRUE(is_lost_in_rounding(make_hull_solid(needle, 2.0)));
}

}  // namespace
}  // namespace ashlar::shape_loss_test

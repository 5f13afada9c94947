#include "mechanics/block/rigid_motions.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar::rigid_motions_test {
namespace {

std::string left_by(const std::vector<BlockSupport>& supports, int order) {
  BlockDefinition block =
      test_support::block_of("A", Polyhedron(make_box({0, 0, 0}, {2, 1, 1})), {1, 1, 0.2}, order);
  block.supports = supports;
  const BlockModel model(block);
  return describe(admissible_rigid_motions(model), model);
}

TEST(RigidMotions, AreNamedAsTheSupportsLeaveThem) {
  for (const int order : {1, 3}) {
    EXPECT_EQ(left_by({}, order), "any rigid motion");
    EXPECT_EQ(left_by({{Plane{{0, 0, 0}, {1, 0, 0}}}}, order), "");
    // a plane whose points move along x only: as one, or with the plane tilting about its own lines
    EXPECT_EQ(
        left_by({{Plane{{0, 0, 0}, {1, 0, 0}}, {false, true, true}}}, order),
        "translation along [1, 0, 0], rotation about [0, 1, 0] through [0, 0.5, 0.5], rotation about [0, 0, "
        "1] through [0, 0.5, 0.5]");
    // a hinge along x through the lower back edge
    EXPECT_EQ(left_by({{Vector3(0, 0, 0)}, {Vector3(2, 0, 0)}}, order),
              "rotation about [1, 0, 0] through [1, 0, 0]");
    // a plane that may slide in itself: two translations and a turn about its normal
    EXPECT_EQ(
        left_by({{Plane{{0, 0, 0}, {0, 0, 1}}, {false, false, true}}}, order),
        "translation along [1, 0, 0], translation along [0, 1, 0], rotation about [0, 0, 1] through [1, 0.5, "
        "0.5]");
  }
  // a ball joint: three rotations through the point
  const std::string ball = left_by({{Vector3(0, 0, 0)}}, 2);
  EXPECT_NE(ball.find("rotation about [1, 0, 0] through [1, 0, 0]"), std::string::npos) << ball;
  EXPECT_NE(ball.find("rotation about [0, 1, 0] through [0, 0.5, 0]"), std::string::npos) << ball;
  EXPECT_NE(ball.find("rotation about [0, 0, 1] through [0, 0, 0.5]"), std::string::npos) << ball;
}

}  // namespace
}  // namespace ashlar::rigid_motions_test

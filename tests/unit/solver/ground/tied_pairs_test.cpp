#include "solver/ground/tied_pairs.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar::tied_pairs_test {
namespace {

BlockModel box(const Vector3& low, const Vector3& high) {
  return BlockModel(test_support::block_of("box", Polyhedron(make_box(low, high)), {2500.0, 1e9, 0.25}, 1));
}

// 1e5 E / size of the stiffer block, 1e5 * 1e9 Pa / 1 m; a fixed one has no stiffness.
TEST(TiedPairs, ATieHasTheStiffnessOfTheStifferBlock) {
  const StiffnessSource large{2.0, 1e9, false}, small{1.0, 1e9, false}, fixed{0.1, 1e12, true};
  const TieRequest tie = automatic_tie(3, 5, large, small);
  EXPECT_EQ(tie.a, 3);
  EXPECT_EQ(tie.b, 5);
  EXPECT_DOUBLE_EQ(tie.stiffness, 1e14);
  EXPECT_DOUBLE_EQ(automatic_tie(0, 1, fixed, large).stiffness, 0.5e14);
}

TEST(TiedPairs, BlocksAreTiedOverACommonFace) {
  const BlockModel cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(have_common_face(cube, box({1, 0.5, 0}, {2, 1.5, 1})));
  EXPECT_TRUE(have_common_face(box({1, 0.5, 0}, {2, 1.5, 1}), cube));
  EXPECT_FALSE(have_common_face(cube, box({1, 1, 0}, {2, 2, 1}))) << "an edge";
  EXPECT_FALSE(have_common_face(cube, box({1.5, 0, 0}, {2, 1, 1}))) << "apart";
}

}  // namespace
}  // namespace ashlar::tied_pairs_test

#include "solver/contact/depth_audit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/sample_solids.hpp"
#include "support/simulations.hpp"

namespace ashlar::depth_audit_test {
namespace {

using test_support::block_of;

const Material rock{2500.0, 1e10, 0.2};
const AuditScope all_pairs{[](int, int) { return true; }, std::vector<bool>(8, true), 1e-6};

/// Audits two blocks where they are placed.
std::vector<PairDepth> audit(const Polyhedron& first, const Polyhedron& second, int order,
                             const AuditScope& scope = all_pairs) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("first", first, rock, order));
  blocks.emplace_back(block_of("second", second, rock, order));
  std::vector<BlockState> states;
  std::vector<BlockSurface> surfaces;
  for (const BlockModel& block : blocks) {
    states.push_back(block.initial_state());
    surfaces.emplace_back(block, 0, Eigen::Matrix3d::Identity());
  }
  DepthAudit audit(2);
  (void)audit.run(blocks, states, surfaces, scope);
  return audit.run(blocks, states, surfaces, scope).depths;  // with what the first one has found clear
}

Polyhedron cube(const Vector3& low, double side = 1.0) {
  return Polyhedron(make_box(low, low + Vector3::Constant(side)));
}

TEST(DepthAudit, ACornerInAFaceIsAsDeepAsItIs) {
  const Polyhedron corner_down = test_support::turned(
      cube({0, 0, 0}),
      Eigen::AngleAxisd(Eigen::Quaterniond::FromTwoVectors(Vector3(1, 1, 1), Vector3(0, 0, 1))));
  std::vector<Vector3> points;
  for (const Vector3& point : corner_down.mesh().points) points.emplace_back(point + Vector3(4, 3, 9.9));
  for (const int order : {1, 2}) {
    const auto depths = audit(corner_down.with_points(points), cube({0, 0, 0}, 10.0), order);
    ASSERT_EQ(depths.size(), 1U);
    EXPECT_EQ(depths[0].blocks, (std::array{0, 1}));
    EXPECT_NEAR(depths[0].depth, 0.1, 1e-12);
    EXPECT_NEAR((depths[0].place - Vector3(4, 3, 9.9)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((depths[0].normal - Vector3::UnitZ()).norm(), 0.0, 1e-12);
  }
}

TEST(DepthAudit, EdgesThatCrossAreSeenWithoutACornerInside) {
  // A bar with its lower edge along x across an upper edge along y: both go in by 0.1 along z, so that the
  // other block's flanks at 45 degrees are 0.1 / sqrt(2) away.
  const auto bar = [](const Vector3& along, double z) {
    const Vector3 side = Vector3::UnitZ().cross(along);
    std::vector<Vector3> points;
    for (const double end : {-2.0, 2.0})
      for (const auto& [s, h] : {std::pair{0.0, 0.5}, {0.5, 0.0}, {0.0, -0.5}, {-0.5, 0.0}})
        points.emplace_back(end * along + s * side + (z + h) * Vector3::UnitZ());
    return Polyhedron(make_convex_hull(points));
  };
  const auto depths = audit(bar(Vector3::UnitX(), 0.9), bar(Vector3::UnitY(), 0.0), 1);
  ASSERT_EQ(depths.size(), 2U);
  for (const PairDepth& depth : depths) EXPECT_NEAR(depth.depth, 0.1 / std::sqrt(2.0), 1e-12);
}

// Flush on each other all corners and edges of both are on the other's sides: only the middles of faces are inside.
TEST(DepthAudit, ABlockThatIsFlushOnAnotherIsAsDeepAsItHasSunkIn) {
  const auto prism = [](double low) {
    return Polyhedron(make_convex_hull(std::vector<Vector3>{
        {0, 0, low}, {3, 0, low}, {0, 3, low}, {0, 0, low + 2}, {3, 0, low + 2}, {0, 3, low + 2}}));
  };
  for (const int order : {1, 2}) {
    for (const auto& depths :
         {audit(cube({0, 0, 0.97}), cube({0, 0, 0}), order), audit(prism(1.97), prism(0), order)}) {
      ASSERT_EQ(depths.size(), 2U) << "each in the other";
      for (const PairDepth& depth : depths) EXPECT_NEAR(depth.depth, 0.03, 1e-12);
      EXPECT_NEAR(depths[0].normal.z(), depths[0].blocks[0] == 0 ? 1.0 : -1.0, 1e-12);
    }
  }
}

TEST(DepthAudit, BlocksThatTouchOrArePassedOverHaveNone) {
  EXPECT_TRUE(audit(cube({0, 0, 1}), cube({0, 0, 0}), 1).empty());
  AuditScope none = all_pairs;
  none.pairs = [](int, int) { return false; };
  EXPECT_TRUE(audit(cube({0, 0, 0.5}), cube({0, 0, 0}), 1, none).empty());
}

TEST(DepthAudit, ACornerInTheNotchOfAnLIsOutside) {
  // The notch is x > 1, y > 1: a cube in it has no contact, one moved 0.1 into its inner edge is in.
  EXPECT_TRUE(audit(cube({1.1, 1.1, 0.1}, 0.5), test_support::l_shaped_prism(), 1).empty());
  const auto depths = audit(cube({0.9, 0.9, 0.25}, 0.5), test_support::l_shaped_prism(), 1);
  ASSERT_FALSE(depths.empty());
  // Its lower corners are sqrt(0.02) from the reflex edge, its vertical edge as deep between them.
  EXPECT_NEAR(depths[0].depth, std::sqrt(0.02), 1e-6);
}

TEST(DepthAudit, WhatHasHardlyMovedIsNotAskedAgain) {
  // A cube 0.1 deep in the one below.
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("above", cube({0.2, 0.2, 0.9}, 0.5), rock, 1));
  blocks.emplace_back(block_of("below", cube({0, 0, 0}), rock, 1));
  std::vector<BlockState> states;
  std::vector<BlockSurface> surfaces;
  for (const BlockModel& block : blocks) {
    states.push_back(block.initial_state());
    surfaces.emplace_back(block, 0, Eigen::Matrix3d::Identity());
  }
  AuditScope scope = all_pairs;
  scope.unmoved = 1e-3;
  scope.fine = false;
  DepthAudit audit(2);
  KnownDepths known;
  const Audit first = audit.run(blocks, states, surfaces, scope, known);
  EXPECT_EQ(first.moved.size(), 2U);
  ASSERT_FALSE(first.depths.empty());
  EXPECT_EQ(first.depths[0].blocks, (std::array{0, 1}));
  EXPECT_NEAR(first.depths[0].depth, 0.1, 1e-12);
  first.take_over(known);
  const auto move = [&](double down) {
    states[0].position += blocks[0].basis().linear_field({0, 0, -down}, Eigen::Matrix3d::Zero());
  };
  move(4e-4);
  // The audit of a resumed run has the same memory.
  DepthAudit resumed(2);
  for (DepthAudit* one : {&audit, &resumed}) {
    const Audit second = one->run(blocks, states, surfaces, scope, known);
    EXPECT_TRUE(second.moved.empty());
    ASSERT_EQ(second.depths.size(), first.depths.size());
    EXPECT_NEAR(second.depths[0].depth, 0.1 + 4e-4, 1e-12);
  }
  move(7e-4);  // 1.1e-3 since it was looked at
  const Audit third = audit.run(blocks, states, surfaces, scope, known);
  EXPECT_EQ(third.moved, std::vector{0});
  EXPECT_NEAR(third.depths[0].depth, 0.1 + 1.1e-3, 1e-12);
}

}  // namespace
}  // namespace ashlar::depth_audit_test

#include "mechanics/block/block_parts.hpp"

#include <gtest/gtest.h>

#include "mechanics/block/block_model.hpp"
#include "support/sample_solids.hpp"
#include "support/simulations.hpp"

namespace ashlar::block_parts_test {
namespace {

const Material rock{2000.0, 3e9, 0.25};

Polyhedron moved(const Polyhedron& solid, const Vector3& displacement) {
  std::vector<Vector3> points;
  for (const Vector3& point : solid.mesh().points) points.emplace_back(point + displacement);
  return solid.with_points(std::move(points));
}

BlockDefinition block(const Polyhedron& solid, int order = 3) {
  return test_support::block_of("A", solid, rock, order);
}

TEST(BlockParts, BlocksThatDifferByATranslationShare) {
  const Polyhedron solid = test_support::l_shaped_prism();
  const Vector3 displacement(3, -5, 0.25);  // exact in binary
  BlockPartsLibrary library;
  const BlockModel first(block(solid), library);
  const BlockModel second(block(moved(solid, displacement)), library);
  EXPECT_EQ(library.size(), 1U);
  EXPECT_EQ(&first.space(), &second.space());
  EXPECT_EQ(&first.basis().derivative(0), &second.basis().derivative(0));
  const BlockModel alone(block(moved(solid, displacement)));
  EXPECT_EQ(second.basis().centroid(), alone.basis().centroid());
  EXPECT_EQ(second.basis().identity_map(), alone.basis().identity_map());
  for (const Vector3& point : alone.solid().mesh().points)
    EXPECT_EQ(second.basis().values(point), alone.basis().values(point));
}

TEST(BlockParts, WhatMattersIsNotShared) {
  const Polyhedron solid(make_box({0, 0, 0}, {1, 2, 3}));
  BlockPartsLibrary library;
  std::vector<BlockDefinition> definitions(8, block(solid));
  definitions[1].order = 2;
  definitions[2].material.young_modulus *= 2.0;
  definitions[3].solid =
      std::make_shared<const Polyhedron>(make_box({0, 0, 0}, {1, 2, std::nextafter(3.0, 4.0)}));
  definitions[4].supports.push_back({Plane{{0, 0, 0}, {0, 0, 1}}});
  definitions[5].supports.push_back({Plane{{0, 0, 0}, {0, 0, 1}}, {true, false, true}});
  definitions[6].supports.push_back({Vector3(0, 0, 1)});
  definitions[7].fixed = true;
  for (std::size_t k = 0; k < definitions.size(); ++k) {
    const BlockModel model(definitions[k], library);
    EXPECT_EQ(library.size(), k + 1);
  }
  // Density, name and loads are the block's own.
  definitions[4].name.push_back('B');
  definitions[4].material.density = 1.0;
  definitions[4].loads.push_back({Vector3(1, 2, 3), false, {1, 0, 0}, {}});
  EXPECT_EQ(BlockModel(definitions[4], library).mass(), 6.0);
  EXPECT_EQ(library.size(), definitions.size());
}

TEST(BlockParts, RoundedTranslationsShareTheirShape) {
  const auto shape = std::make_shared<const Polyhedron>(make_box({0, 0, 0}, {0.1, 0.2, 0.3}));
  BlockPartsLibrary without;
  BlockPartsLibrary with;
  for (int k = 0; k < 7; ++k) {
    BlockDefinition definition = block(moved(*shape, Vector3(0.7 * k, -0.3 * k, 1e3)));
    definition.supports.push_back({Plane{{0, 0, 1e3}, {0, 0, 1}}});
    definition.supports.push_back({Vector3(0.7 * k + 0.1, -0.3 * k + 0.2, 1e3 + 0.3), {true, false, false}});
    const BlockModel own(definition, without);
    definition.shape = shape;
    // The point's distance from the first corner is rounded with the place; all else is the shape's.
    definition.supports.pop_back();
    const BlockModel shared(definition, with);
    EXPECT_NEAR(shared.basis().centroid().z(), 1e3 + 0.15, 1e-12);
    // Exactly the volume of the shape, independent of rounding by its placement.
    EXPECT_EQ(shared.basis().volume(), PolynomialBasis(*shape, 1).volume());
    // The clamp of the placed block is met.
    const Eigen::MatrixX3d motion = shared.space().expand(Eigen::VectorXd::Ones(shared.unknowns())) /
                                    shared.basis().values(shared.basis().centroid()).norm();
    for (const int corner : shared.solid().faces()[0].loops[0]) {
      const Vector3& point = shared.solid().mesh().points[static_cast<std::size_t>(corner)];
      if (point.z() != 1e3) continue;
      EXPECT_LT((motion.transpose() * shared.basis().values(point)).norm(), 1e-9);
    }
  }
  EXPECT_GT(without.size(), 1U);
  EXPECT_EQ(with.size(), 1U);
}

TEST(BlockParts, HigherOrdersThatAreSharedHaveTheBitsOfSingleOnes) {
  const Polyhedron solid = test_support::l_shaped_prism();
  const Vector3 displacement(3, -5, 0.25);  // exact in binary
  BlockPartsLibrary library;
  const BlockModel low(block(moved(solid, displacement), 1));
  (void)BlockModel(block(solid, 1)).with_order(3, library);
  const BlockModel shared = low.with_order(3, library), alone = low.with_order(3);
  EXPECT_EQ(library.size(), 1U);
  EXPECT_EQ(shared.order(), 3);
  EXPECT_EQ(shared.parts()->stiffness, alone.parts()->stiffness);
  EXPECT_EQ(shared.parts()->mean_gradients, alone.parts()->mean_gradients);
  EXPECT_EQ(shared.basis().identity_map(), alone.basis().identity_map());
}

TEST(BlockParts, SupportedPointsMoveWithTheShape) {
  const auto shape = std::make_shared<const Polyhedron>(make_box({0, 0, 0}, {1, 2, 4}));
  BlockDefinition definition = block(moved(*shape, {16, 0, 0}));
  definition.shape = shape;
  for (const auto& [point, components] : {std::pair{Vector3(16, 0, 0), std::array{true, true, true}},
                                          {Vector3(17, 0, 0), std::array{false, true, true}},
                                          {Vector3(16, 2, 0), std::array{false, false, true}}})
    definition.supports.push_back({point, components});
  const BlockModel there(definition);
  ASSERT_TRUE(there.space().held());
  const auto position = there.equilibrium({0, 0, -9.81}, 0.0);
  ASSERT_TRUE(position.has_value());
  const Vector3 corner = position->transpose() * there.basis().values(Vector3(16, 2, 0));
  EXPECT_NEAR(corner.z(), 0.0, 1e-12);
  EXPECT_GT(std::abs(corner.x() - 16.0) + std::abs(corner.y() - 2.0), 1e-9) << "only z is held";
}

}  // namespace
}  // namespace ashlar::block_parts_test

#include "solver/state/block_system.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar::block_system_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::same_law;

const Material rock{2000.0, 1e9, 0.25};

BlockDefinition box(double from, double to, int order = 1) {
  return block_of("box", Polyhedron(make_box({from, 0, 0}, {to, 1, 1})), rock, order);
}

/// A clamped box, two that follow it in a row, one apart, and a base.
BlockSystem row(const std::vector<TieRequest>& ties) {
  std::vector<BlockModel> blocks;
  BlockDefinition clamped = box(0, 1);
  clamped.supports.push_back({Plane{Vector3::Zero(), Vector3::UnitX()}});
  blocks.emplace_back(std::move(clamped));
  blocks.emplace_back(box(1, 2));
  blocks.emplace_back(box(2, 3));
  blocks.emplace_back(box(10, 18));
  blocks.emplace_back(fixed_box({-1, -1, -1}, {20, 2, 0}));
  return {std::move(blocks), same_law({}), SimulationSettings{}, ties};
}

TEST(BlockSystem, TiesBlocksWithACommonFaceAndLeavesTheOthersOut) {
  const BlockSystem system = row({{0, 1, 1e12}, {1, 2, 1e12}, {2, 3, 1e12}});
  EXPECT_TRUE(system.are_tied(0, 1) && system.are_tied(1, 2));
  EXPECT_FALSE(system.are_tied(2, 3)) << "7 m apart";
  EXPECT_TRUE(system.is_tied(2));
  EXPECT_FALSE(system.is_tied(3));
  EXPECT_EQ(system.left_out(), (std::set<PairKey>{{0, 1}, {1, 2}, {2, 3}}));
  // A block tied to a supported one is not free.
  EXPECT_EQ(system.free_bodies(), (std::vector<std::vector<int>>{{3}}));
}

TEST(BlockSystem, BlocksAreHeldByTheSupportsOfThoseTheyAreTiedTo) {
  EXPECT_EQ(row({}).held_without_contacts(), (std::vector<bool>{true, false, false, false, true}));
  EXPECT_EQ(row({{1, 2, 1e12}, {0, 1, 1e12}}).held_without_contacts(),
            (std::vector<bool>{true, true, true, false, true}));
}

TEST(BlockSystem, DecidesWhatTransmitsTheForceOfEachJoint) {
  const auto decided = [](Transmission given, bool has_multipliers) {
    std::vector<BlockModel> blocks;
    blocks.emplace_back(box(0, 1));
    blocks.emplace_back(box(1, 2));
    JointLaw law;
    law.transmission = given;
    SimulationSettings settings;
    settings.augmented = has_multipliers;
    return BlockSystem(std::move(blocks), same_law(law), settings, {}).law(0, 1).transmission;
  };
  EXPECT_EQ(decided(Transmission::by_scene, true), Transmission::multipliers);
  EXPECT_EQ(decided(Transmission::springs, true), Transmission::springs);
  // A law that was decided in a scene with multipliers, as a system without them has it.
  for (const Transmission given : {Transmission::by_scene, Transmission::springs, Transmission::multipliers})
    EXPECT_EQ(decided(given, false), Transmission::springs);
}

TEST(BlockSystem, HoldsBlocksUntilTheyAreLetGo) {
  BlockSystem system = row({});
  system.hold({1, 3});
  EXPECT_EQ(system.moving(), (std::vector<bool>{true, false, true, false, false}));
  system.let_go();
  EXPECT_EQ(system.moving(), (std::vector<bool>{true, true, true, true, false}));
}

TEST(BlockSystem, KnowsSizesAndUnknowns) {
  const BlockSystem system = row({});
  EXPECT_NEAR(system.smaller_size({1, 3}), 1.0, 1e-12);  // cube roots of 1 and 8 m^3
  EXPECT_NEAR(system.smaller_size({3, 4}), 2.0, 1e-12);
  // 12 of a free block of order 1; a clamped face leaves the 3 functions x e_i of them.
  EXPECT_EQ(system.unknowns(), 3 + 3 * 12);
}

TEST(BlockSystem, AsksEqualBlocksAtTheSamePlaces) {
  BlockSystem system = row({});
  ASSERT_NE(system.asked_gradients(1), nullptr);
  EXPECT_EQ(system.asked_gradients(1)->rows(), 3) << "an affine block is the same everywhere";
  EXPECT_EQ(system.asked_gradients(4), nullptr) << "fixed";
  system.replace(1, system.blocks()[1].with_order(2));
  // Middle, 8 corners, 12 edges, 6 faces; 10 functions.
  EXPECT_EQ(system.asked_gradients(1)->rows(), 3 * (1 + 8 + 12 + 6));
  EXPECT_EQ(system.asked_gradients(1)->cols(), 10);
  EXPECT_EQ(system.asked_gradients(2)->rows(), 3) << "its twin stays";
}

TEST(BlockSystem, IncrementalBlocksAreNotTied) {
  std::vector<BlockModel> blocks;
  for (int k = 0; k < 2; ++k) {
    BlockDefinition block = box(k, k + 1);
    block.formulation = Formulation::incremental;
    blocks.emplace_back(std::move(block));
  }
  EXPECT_THROW(BlockSystem(std::move(blocks), same_law({}), SimulationSettings{}, {{0, 1, 1e12}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::block_system_test

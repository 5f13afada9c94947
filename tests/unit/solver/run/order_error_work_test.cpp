#include "solver/run/order_error_work.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/simulations.hpp"

namespace ashlar::order_error_work_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::run_until;
using test_support::same_law;

const Material stone{2500.0, 1e10, 0.2};

/// A cube of 12 triangles.
BlockDefinition cube(double x, int order) {
  return block_of("cube", Polyhedron(make_box({x, 0, 0}, {x + 1.0, 1, 1})), stone, order);
}

// Order 3 has p = 20: 20 * 8000 + 50 * 12 * 400 and 6 * 8000.
TEST(OrderErrorWork, GrowsWithFunctionsAndTriangles) {
  const BlockModel block(cube(0.0, 1));
  EXPECT_EQ(work_of_model(block, 3), 400000.0);
  EXPECT_EQ(work_of_solution(block, 3), 48000.0);
}

// Its strain has order 4, p = 35: 20 * 42875 + 50 * 12 * 1225 more, and 6 * 42875.
TEST(OrderErrorWork, OfLargeStrainsIsMore) {
  BlockDefinition definition = cube(0.0, 2);
  definition.material.elasticity = Elasticity::st_venant_kirchhoff;
  const BlockModel block(std::move(definition));
  EXPECT_EQ(work_of_model(block, 3), 400000.0 + 1592500.0);
  EXPECT_EQ(work_of_solution(block, 3), 257250.0);
}

// Order 1 has p = 4: 20 * 64 + 50 * 12 * 16 a model, 20000 + 100 * 16 a step of a block.
TEST(OrderErrorWork, OfARunHasModelsAndSteps) {
  for (const bool shared : {false, true}) {
    BlockPartsLibrary library;
    std::vector<BlockModel> blocks;
    blocks.emplace_back(fixed_box({-1, -1, -10}, {20, 2, -9}));
    for (const double x : {0.0, 8.0})
      shared ? (void)blocks.emplace_back(cube(x, 1), library) : (void)blocks.emplace_back(cube(x, 1));
    Simulation simulation(std::move(blocks), {{}, {}, {}}, same_law({1e9, 1e9, 0.5}), SimulationSettings{});
    const double models = (shared ? 1.0 : 2.0) * 10880.0;
    EXPECT_EQ(work_of_run(simulation), models);
    ASSERT_TRUE(run_until(simulation, 0.01));
    ASSERT_GT(simulation.steps(), 0);
    EXPECT_EQ(simulation.counts().contact_points, 0U);
    EXPECT_EQ(work_of_run(simulation), models + simulation.steps() * 2.0 * 21600.0);
    EXPECT_EQ(largest_estimate_work(simulation), 2e8) << "5 % of this run are less";
  }
}

TEST(OrderErrorWork, BlocksWithTheSameDataAreGrouped) {
  BlockPartsLibrary library;
  BlockDefinition held = cube(16.0, 1);
  held.supports.push_back({Plane{{0, 0, 1}, Vector3::UnitZ()}});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(cube(0.0, 1), library);
  blocks.emplace_back(cube(4.0, 1));
  blocks.emplace_back(cube(8.0, 1), library);
  for (int k = 0; k < 2; ++k) blocks.emplace_back(held, library);
  using Groups = std::vector<std::vector<int>>;
  EXPECT_EQ(equal_blocks(blocks, {0, 1, 2, 3, 4}), (Groups{{0, 2}, {1}, {3}, {4}}));
  EXPECT_EQ(equal_blocks(blocks, {2, 1}), (Groups{{2}, {1}}));
  EXPECT_TRUE(equal_blocks(blocks, {}).empty());
}

TEST(OrderErrorWork, GroupsAreLimited) {
  const std::vector<BlockModel> blocks(largest_equal_group + 1, BlockModel(cube(0.0, 1)));
  std::vector<int> all;
  for (int k = 0; k < static_cast<int>(blocks.size()); ++k) all.push_back(k);
  const auto groups = equal_blocks(blocks, all);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].size(), largest_equal_group);
  EXPECT_EQ(groups[1], std::vector<int>{all.back()});
}

TEST(EstimateBudget, EqualBlocksTakeTheirModelOnce) {
  BlockPartsLibrary library;
  const BlockModel first(cube(0.0, 1), library), second(cube(4.0, 1), library), other(cube(8.0, 1));
  EstimateBudget budget(400000.0 + 2 * 48000.0 + 47999.0);
  EXPECT_FALSE(budget.take(first, 6)) << "p = 84";
  EXPECT_TRUE(budget.take(first, 3));
  EXPECT_FALSE(budget.take(other, 3)) << "its model does not fit";
  EXPECT_TRUE(budget.take(second, 3));
  EXPECT_FALSE(budget.take(first, 3)) << "one unit is missing";
  EstimateBudget all(std::numeric_limits<double>::infinity());
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(all.take(other, 12));
}

TEST(EstimateBudget, EachGroupHasAModel) {
  const BlockModel block(cube(0.0, 1));
  EstimateBudget budget(2 * 400000.0 + (largest_equal_group + 1.0) * 48000.0);
  for (std::size_t k = 0; k < largest_equal_group + 1; ++k) EXPECT_TRUE(budget.take(block, 3)) << k;
  EXPECT_FALSE(budget.take(block, 3));
}

}  // namespace
}  // namespace ashlar::order_error_work_test

#include "solver/step/island/island.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"
#include "unit/solver/contact/sample_pair.hpp"

namespace ashlar::island_test {
namespace {

const BlockModel& cube() {
  static const BlockModel block(
      test_support::block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {1, 1, 0}, 1));
  return block;
}

const BlockState& at_rest() {
  static const BlockState state = cube().initial_state();
  return state;
}

/// One spring between two blocks.
ContactPair pair_of(int a, int b) {
  return {{a, b, {&cube(), &at_rest(), nullptr}, {&cube(), &at_rest(), nullptr}},
          JointLaw{},
          {{test_support::level_point({0, 0, 0}, 0.0)}},
          {{}}};
}

ContactPair tie_of(int a, int b, const Tie& tie) {
  return {{a, b, {&cube(), &at_rest(), nullptr}, {&cube(), &at_rest(), nullptr}},
          std::make_shared<const Tie>(tie),
          1.0};
}

TEST(Island, IsASetOfMovingBlocksThatTouch) {
  const std::vector<ContactPair> pairs = {pair_of(0, 1), pair_of(1, 3), pair_of(4, 5)};
  const std::vector<Island> islands = find_islands(std::vector<bool>(6, true), pairs);
  ASSERT_EQ(islands.size(), 3U);
  EXPECT_EQ(islands[0].bodies, (std::vector<int>{0, 1, 3}));
  EXPECT_EQ(islands[0].pairs, (std::vector<int>{0, 1}));
  EXPECT_EQ(islands[1].bodies, (std::vector<int>{2}));
  EXPECT_TRUE(islands[1].pairs.empty());
  EXPECT_EQ(islands[2].bodies, (std::vector<int>{4, 5}));
  EXPECT_EQ(islands[2].pairs, (std::vector<int>{2}));
}

TEST(Island, IsNotJoinedByAFixedBlock) {
  // 0 and 2 stand on 1.
  const std::vector<ContactPair> pairs = {pair_of(0, 1), pair_of(1, 2)};
  const std::vector<Island> islands = find_islands({true, false, true}, pairs);
  ASSERT_EQ(islands.size(), 2U);
  EXPECT_EQ(islands[0].bodies, (std::vector<int>{0}));
  EXPECT_EQ(islands[0].pairs, (std::vector<int>{0}));
  EXPECT_EQ(islands[1].bodies, (std::vector<int>{2}));
  EXPECT_EQ(islands[1].pairs, (std::vector<int>{1}));
}

TEST(Island, TiesJoinBlocksAsContactsDo) {
  const Polyhedron below(make_box({0, 0, 0}, {1, 1, 1})), above(make_box({0, 0, 1}, {1, 1, 2}));
  const Tie tie = tie_between(below, PolynomialBasis(below, 1), above, PolynomialBasis(above, 1));
  std::vector<ContactPair> pairs;
  pairs.push_back(pair_of(0, 1));
  pairs.push_back(tie_of(1, 2, tie));
  const std::vector<bool> moving(4, true);
  const std::vector<Island> islands = find_islands(moving, pairs);
  ASSERT_EQ(islands.size(), 2U);
  EXPECT_EQ(islands[0].bodies, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(islands[0].pairs, (std::vector<int>{0, 1})) << "the tie's equations are the island's, too";
  EXPECT_EQ(islands[1].bodies, (std::vector<int>{3}));
  EXPECT_NO_THROW(validate(islands, moving, pairs));
  EXPECT_THROW(validate({{{0, 1}, {0}}, {{2}, {}}, {{3}, {}}}, moving, pairs), std::logic_error)
      << "the tie's blocks are in two";
}

TEST(Island, SetsThatCannotBeAreRefused) {
  const std::vector<ContactPair> pairs = {pair_of(0, 1)};
  const std::vector<bool> moving = {true, true, false};
  EXPECT_NO_THROW(validate({{{0, 1}, {0}}}, moving, pairs));
  EXPECT_THROW(validate({{{0}, {0}}, {{1}, {}}}, moving, pairs), std::logic_error) << "joined by a contact";
  EXPECT_THROW(validate({{{0, 1}, {}}}, moving, pairs), std::logic_error) << "its contact is missing";
  EXPECT_THROW(validate({{{0, 1}, {0}}, {{1}, {}}}, moving, pairs), std::logic_error) << "in two";
  EXPECT_THROW(validate({{{0, 1}, {0}}, {{2}, {}}}, moving, pairs), std::logic_error) << "fixed";
  EXPECT_THROW(validate({{{0}, {}}}, moving, {}), std::logic_error) << "1 is in none";
  EXPECT_THROW(validate({{{1, 0}, {0}}}, moving, pairs), std::logic_error) << "not in order";
}

TEST(IslandSolvers, KeepAFactorAsLongAsItComesUp) {
  IslandSolvers solvers{LinearMethod::cholesky};
  const std::vector<int> key = {0, 3, 4};
  const auto* first = &solvers.find(key, {12, 12}, {{0, 1}});
  solvers.drop_unused();
  EXPECT_EQ(&solvers.find(key, {12, 12}, {{0, 1}}), first) << "it came up in the step before";
  EXPECT_NE(&solvers.find({1, 3, 4}, {12, 12}, {{0, 1}}), first) << "another role has its own";
}

// A pile that falls, meets with friction and a turn, and comes to lie; the orders of its blocks differ.
TEST(IslandSolvers, ConjugateGradientsGiveWhatAFactorGives) {
  const auto run = [](LinearMethod method) {
    SimulationSettings settings;
    settings.time_step = 1.0 / 240.0;
    settings.linear_method = method;
    std::vector<BlockModel> blocks;
    blocks.emplace_back(test_support::fixed_box({-3, -3, -1}, {3, 3, 0}));
    for (const int order : {0, 1, 2}) {
      const Vector3 low(0.3 * order, 0.1 * order, 0.01 + 1.01 * order);
      blocks.emplace_back(test_support::block_of("stone", Polyhedron(make_box(low, low + Vector3::Ones())),
                                                 {2500, 1e8, 0.2}, order));
    }
    Simulation simulation(std::move(blocks), {{}, {}, {Vector3::Zero(), Vector3(0, 0, 0.5)}, {}},
                          test_support::same_law({1e9, 1e9, 0.3, 0.0, 0.0, true}), settings);
    EXPECT_TRUE(test_support::run_until(simulation, 0.2));
    return simulation;
  };
  const Simulation factored = run(LinearMethod::cholesky);
  const Simulation iterated = run(LinearMethod::conjugate_gradients);
  EXPECT_EQ(factored.counts().factors.gradient_iterations, 0U);
  EXPECT_GT(iterated.counts().factors.gradient_iterations, 0U);
  // Blocks on their own have factors.
  EXPECT_LT(10 * iterated.counts().factors.factorizations, factored.counts().factors.factorizations);
  for (int block = 1; block <= 3; ++block) {
    const Vector3 corner = factored.blocks()[static_cast<std::size_t>(block)].solid().mesh().points.front();
    EXPECT_LT(
        (test_support::place_of(factored, block, corner) - test_support::place_of(iterated, block, corner))
            .norm(),
        1e-9)
        << block;
  }
}

}  // namespace
}  // namespace ashlar::island_test

#include "solver/contact/energy_bounds.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"
#include "unit/solver/contact/sample_pair.hpp"

namespace ashlar::energy_bounds_test {
namespace {

/// A spring of 2 N/m and some depth, which holds its square.
ContactPair pair_at_depth(int a, int b, double depth, double tensile_strength = 0.0) {
  static const BlockModel block(
      test_support::block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {1, 1, 0}, 1));
  const BlockState state = block.initial_state();
  PointMemory memory;
  memory.intact = true;
  const JointLaw law{2.0, 1.0, 0.5, 0.0, tensile_strength, true};
  return {{a, b, {&block, &state, nullptr}, {&block, &state, nullptr}},
          law,
          {{test_support::level_point({0.5, 0.5, 0.0}, -depth)}},
          {memory}};
}

PairHistory that_held(double normal, double shear = 0.0) {
  PairHistory pair;
  pair.memory = ContactMemory({}, {}, 0.0, {normal, shear}, 0.0);
  return pair;
}

std::vector<double> normal_bounds(const std::vector<ContactPair>& pairs, const PairHistories& memory,
                                  const std::vector<bool>& moving) {
  std::vector<double> result;
  for (const SpringEnergy& bound : energy_bounds(pairs, memory, moving)) result.push_back(bound.normal);
  return result;
}

const std::vector<bool> all_move(4, true);

TEST(EnergyBounds, AreWhatThePairHeldAndNothingOfANewOne) {
  const std::vector<ContactPair> pairs = {pair_at_depth(0, 1, 3), pair_at_depth(2, 3, 1)};
  const PairHistories memory = {{{0, 1}, that_held(4, 2)}};
  const auto bounds = energy_bounds(pairs, memory, all_move);
  ASSERT_EQ(bounds.size(), 2U);
  EXPECT_EQ(bounds[0].normal, 4.0);
  EXPECT_EQ(bounds[0].shear, 2.0);
  // It has no block in common with the other one.
  EXPECT_EQ(bounds[1].normal, 0.0);
  EXPECT_EQ(bounds[1].shear, 0.0);
}

TEST(EnergyBounds, ABlockTakesAlongWhatItNoLongerHoldsElsewhere) {
  const PairHistories memory = {{{0, 1}, that_held(6, 5)}};
  // It has left 1: no more goes along than the 4 J that are needed, no more than the 6 J that there are.
  EXPECT_EQ(normal_bounds({pair_at_depth(0, 2, 2)}, memory, all_move), (std::vector<double>{4}));
  EXPECT_EQ(normal_bounds({pair_at_depth(0, 2, 3)}, memory, all_move), (std::vector<double>{6}));
  // Shear does not.
  EXPECT_EQ(energy_bounds({pair_at_depth(0, 2, 3)}, memory, all_move)[0].shear, 0.0);
  // 1 J of the 6 J is still held there; the others, with a deficit of 4 J each, receive half of the 5 J each.
  EXPECT_EQ(normal_bounds({pair_at_depth(0, 1, 1), pair_at_depth(0, 2, 2), pair_at_depth(0, 3, 2)}, memory,
                          all_move),
            (std::vector<double>{6, 2.5, 2.5}));
  // All of it is: found deeper, it keeps its own.
  EXPECT_EQ(normal_bounds({pair_at_depth(0, 1, 3), pair_at_depth(0, 2, 2)}, memory, all_move),
            (std::vector<double>{6, 0}));
  // A known pair receives the surplus of its own.
  EXPECT_EQ(
      normal_bounds({pair_at_depth(0, 2, 3)}, {{{0, 1}, that_held(6)}, {{0, 2}, that_held(1)}}, all_move),
      (std::vector<double>{7}));
}

TEST(EnergyBounds, AreSharedOutByWhatIsLackedInAnyOrder) {
  // Pairs at block 0 have deficits of 4 and 16 J, and 10 J were lost there: 2 and 8 J.
  const PairHistories memory = {{{0, 1}, that_held(10)}};
  EXPECT_EQ(normal_bounds({pair_at_depth(0, 2, 2), pair_at_depth(0, 3, 4)}, memory, all_move),
            (std::vector<double>{2, 8}));
  EXPECT_EQ(normal_bounds({pair_at_depth(0, 2, 4), pair_at_depth(0, 3, 2)}, memory, all_move),
            (std::vector<double>{8, 2}));
  // Both have a deficit of 4 J at block 0, where 12 J were lost, and receive 4 J. One of them also has block 3, where
  // 6 J were lost: the deficit is covered, and no more is used.
  const PairHistories two = {{{0, 1}, that_held(12)}, {{1, 3}, that_held(6)}};
  EXPECT_EQ(normal_bounds({pair_at_depth(0, 2, 2), pair_at_depth(0, 3, 2)}, two, all_move),
            (std::vector<double>{4, 4}));
  // Of the 4 J at block 0 each would have 2 J; the other one, with 6 J at block 3 too, needs less of them.
  const PairHistories scarce = {{{0, 1}, that_held(4)}, {{1, 3}, that_held(6)}};
  const std::vector<double> shared =
      normal_bounds({pair_at_depth(0, 2, 2), pair_at_depth(0, 3, 2)}, scarce, all_move);
  EXPECT_EQ(shared[1], 4.0);
  // It is offered 2 J and 6 J, and uses half of each; 3 J of the 4 J remain for the other, with a deficit of 4 J.
  EXPECT_DOUBLE_EQ(shared[0], 3.0);
}

TEST(EnergyBounds, NothingGoesAlongWithAFixedBlock) {
  const PairHistories memory = {{{0, 1}, that_held(6)}};
  EXPECT_EQ(normal_bounds({pair_at_depth(0, 2, 2)}, memory, {false, true, true}), (std::vector<double>{0}));
  EXPECT_EQ(normal_bounds({pair_at_depth(1, 2, 2)}, memory, {false, true, true}), (std::vector<double>{4}));
}

TEST(EnergyBounds, BondsNeitherGiveNorTake) {
  const PairHistories memory = {{{0, 1}, that_held(6)}};
  EXPECT_EQ(normal_bounds({pair_at_depth(0, 1, 1, 10), pair_at_depth(0, 2, 2)}, memory, all_move),
            (std::vector<double>{6, 0}));
  EXPECT_EQ(normal_bounds({pair_at_depth(0, 2, 2, 10)}, memory, all_move), (std::vector<double>{0}));
}

}  // namespace
}  // namespace ashlar::energy_bounds_test

#include "solver/step/island.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar {
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
  ContactPoint point{};
  point.face_a = point.face_b = 0;
  point.material_a = point.material_b = point.place_a = point.place_b = Vector3::Zero();
  point.normal = Vector3::UnitZ();
  point.tangent_1 = Vector3::UnitX();
  point.tangent_2 = Vector3::UnitY();
  point.area = 1.0;
  return {{a, b, {&cube(), &at_rest(), nullptr}, {&cube(), &at_rest(), nullptr}}, JointLaw{}, {point}, {{}}};
}

ContactPair tie_of(int a, int b, const Tie& tie) {
  return {{a, b, {&cube(), &at_rest(), nullptr}, {&cube(), &at_rest(), nullptr}}, tie, 1.0};
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

TEST(Island, TiesJoinBlocksButAreNoContacts) {
  const Polyhedron below(make_box({0, 0, 0}, {1, 1, 1})), above(make_box({0, 0, 1}, {1, 1, 2}));
  const Tie tie = tie_between(below, PolynomialBasis(below, 1), above, PolynomialBasis(above, 1));
  std::vector<ContactPair> pairs;
  pairs.push_back(pair_of(0, 1));
  pairs.push_back(tie_of(1, 2, tie));
  const std::vector<Island> islands = find_islands({true, true, true}, pairs);
  ASSERT_EQ(islands.size(), 1U);
  EXPECT_EQ(islands[0].bodies, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(contacts_of(islands[0], pairs), (std::vector<std::array<int, 2>>{{0, 1}}));
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
  IslandSolvers solvers;
  const std::vector<int> key = {0, 3, 4};
  const auto* first = &solvers.find(key, {12, 12}, {{0, 1}});
  solvers.drop_unused();
  EXPECT_EQ(&solvers.find(key, {12, 12}, {{0, 1}}), first) << "it came up in the step before";
  EXPECT_NE(&solvers.find({1, 3, 4}, {12, 12}, {{0, 1}}), first) << "another role has its own";
}

}  // namespace
}  // namespace ashlar

#include "solver/contact/contact_finder.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/simulations.hpp"

namespace ashlar::contact_finder_test {
namespace {

using test_support::block_of;

const Material rock{2500.0, 1e9, 0.2};

BlockModel fixed_block(const std::string& name, const Vector3& low, const Vector3& high) {
  BlockDefinition definition = block_of(name, Polyhedron(make_box(low, high)), rock, 1);
  definition.fixed = true;
  return BlockModel(std::move(definition));
}

struct Scene {
  std::vector<BlockModel> blocks;
  std::vector<BlockState> states;
  void add(BlockModel block) {
    states.push_back(block.initial_state());
    blocks.push_back(std::move(block));
  }
  void move(int block, const Vector3& by) {
    const auto k = static_cast<std::size_t>(block);
    states[k].position += blocks[k].basis().linear_field(by, Eigen::Matrix3d::Zero());
  }
};

SimulationSettings settings_for_test() {
  SimulationSettings settings;
  settings.gravity = Vector3::Zero();
  settings.contact_distance = 1e-3;
  return settings;
}

ExpectedMotion expected(const std::vector<double>& motion) {
  return {motion, [motion](int block) { return motion[static_cast<std::size_t>(block)]; }};
}

Scene cube_over_floor(double gap) {
  Scene scene;
  scene.blocks.reserve(2);
  scene.add(fixed_block("floor", {-5, -5, -1}, {5, 5, 0}));
  scene.add(
      BlockModel(block_of("cube", Polyhedron(make_box({-0.5, -0.5, gap}, {0.5, 0.5, gap + 1})), rock, 1)));
  return scene;
}

/// Two plates 0.2 thick that lie across the diagonal of x and z, 0.5 apart, and far off a floor along the
/// axes that gives boxes their axes: the boxes of the plates meet, they do not.
Scene two_diagonal_plates() {
  const auto diagonal = [](double from, double to) {
    return test_support::tilted_box({-3, -3, from}, {3, 3, to}, 45.0);
  };
  Scene scene;
  scene.blocks.reserve(3);
  BlockDefinition below = block_of("below", diagonal(-0.2, 0.0), rock, 1);
  below.fixed = true;
  scene.add(BlockModel(std::move(below)));
  scene.add(BlockModel(block_of("above", diagonal(0.5, 0.7), rock, 1)));
  scene.add(fixed_block("floor", {-10, -10, -101}, {10, 10, -100}));
  return scene;
}

TEST(ContactFinder, PairsKnownToBeApartAreNotSearchedUntilTheyCouldMeet) {
  Scene scene = two_diagonal_plates();
  ContactFinder finder(scene.blocks, settings_for_test());
  PairHistories histories;
  const std::vector<double> motion = {0.0, 0.05, 0.0};
  EXPECT_TRUE(finder.find(scene.states, expected(motion), histories).empty());
  EXPECT_EQ(finder.counts().block_pairs_tested, 1U);
  const double down = -0.04 * std::sqrt(2.0);  // vertically, 0.04 nearer
  for (int step = 1; step <= 7; ++step) {
    const std::vector<BlockState> before = scene.states;
    scene.move(1, {0, 0, down});
    EXPECT_TRUE(finder.check_motion(before, scene.states, {}, histories).empty());
    finder.accept_motion();
    EXPECT_TRUE(finder.find(scene.states, expected(motion), histories).empty());
  }
  // 0.22 apart, having gone 0.4 of the 0.5: the eighth step could still not close the remaining gap.
  EXPECT_EQ(finder.counts().block_pairs_tested, 1U);
  EXPECT_EQ(finder.counts().block_pairs_far, 7U);
  // With 0.3 expected it could: the pair is looked at again, and found.
  EXPECT_EQ(finder.find(scene.states, expected({0.0, 0.3, 0.0}), histories).size(), 1U);
  EXPECT_EQ(finder.counts().block_pairs_tested, 2U);
}

TEST(ContactFinder, FindsWhatWasSkippedAsSoonAsItCouldMeet) {
  // Random walks of a cube over a floor: with and without memory of clearances the same pairs have contacts.
  std::mt19937_64 random(5);
  Scene scene = cube_over_floor(0.3);
  ContactFinder finder(scene.blocks, settings_for_test());
  PairHistories histories;
  for (int step = 0; step < 200; ++step) {
    const double by = (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5) * 0.05;
    const std::vector<double> motion = {0.0, 0.05};
    const auto found = finder.find(scene.states, expected(motion), histories);
    ContactFinder fresh(scene.blocks, settings_for_test());
    PairHistories of_fresh;
    EXPECT_EQ(found.size(), fresh.find(scene.states, expected(motion), of_fresh).size());
    const std::vector<BlockState> before = scene.states;
    scene.move(1, {0, 0, by});
    (void)finder.check_motion(before, scene.states, found, histories);
    finder.accept_motion();
  }
}

TEST(ContactFinder, GoesOnFromItsState) {
  Scene scene = two_diagonal_plates();
  ContactFinder first(scene.blocks, settings_for_test());
  PairHistories histories;
  (void)first.find(scene.states, expected({0.0, 0.05, 0.0}), histories);
  ContactFinder second(scene.blocks, settings_for_test());
  second.restore(first.state());
  (void)second.find(scene.states, expected({0.0, 0.05, 0.0}), histories);
  EXPECT_EQ(second.counts().block_pairs_tested, 1U);
  EXPECT_EQ(second.counts().block_pairs_far, 1U);
}

TEST(ContactFinder, WhatItSkipsTurnsWithTheScene) {
  // The same plates without the floor: boxes lie along them, and do not meet.
  Scene scene = two_diagonal_plates();
  scene.blocks.pop_back();
  scene.states.pop_back();
  ContactFinder finder(scene.blocks, settings_for_test());
  PairHistories histories;
  EXPECT_TRUE(finder.find(scene.states, expected({0.0, 0.05}), histories).empty());
  EXPECT_EQ(finder.counts().block_pairs_skipped, 1U);
  EXPECT_EQ(finder.counts().block_pairs_tested, 0U);
}

TEST(ContactFinder, BlocksThatWouldPassAreReportedEarliestFirst) {
  Scene scene;
  scene.blocks.reserve(3);
  scene.add(fixed_block("far plate", {-2, -2, -1.01}, {2, 2, -1}));
  scene.add(fixed_block("near plate", {-2, -2, -0.01}, {2, 2, 0}));
  scene.add(BlockModel(block_of("cube", Polyhedron(make_box({-0.5, -0.5, 0.1}, {0.5, 0.5, 1.1})), rock, 1)));
  ContactFinder finder(scene.blocks, settings_for_test());
  PairHistories histories;
  // Nothing is expected to move, so no contact is found; then the cube flies through both plates.
  const auto found = finder.find(scene.states, expected({0.0, 0.0, 0.0}), histories);
  EXPECT_TRUE(found.empty());
  const std::vector<BlockState> before = scene.states;
  scene.move(2, {0, 0, -4});
  const auto passing = finder.check_motion(before, scene.states, found, histories);
  ASSERT_FALSE(passing.empty());
  EXPECT_EQ(passing.front().blocks, (PairKey{1, 2}));
  EXPECT_NEAR(passing.front().touch.share, 0.1 / 4.0, 1e-4);
  EXPECT_EQ(passing.back().blocks, (PairKey{0, 2}));
}

}  // namespace
}  // namespace ashlar::contact_finder_test

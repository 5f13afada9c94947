#include "apps/scene/assemble/chosen_restitution.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace ashlar::chosen_restitution_test {
namespace {

/// A stone of 1 m and 2500 kg, without vibrations that a step resolves.
BlockSummary stone() {
  BlockSummary block;
  block.stiffness = {.size = 1.0, .young_modulus = 1e10, .fixed = false};
  block.mass = 2500.0;
  block.slowest_vibration = std::numeric_limits<double>::infinity();
  return block;
}

Scene motion() {
  Scene scene;
  scene.analysis.type = SceneAnalysis::Type::dynamic;
  scene.analysis.time_step = 1e-3;
  return scene;
}

TEST(ChosenRestitution, StiffBlocksDoNotRebound) {
  const std::vector<BlockSummary> blocks = {stone(), stone()};
  EXPECT_EQ(ChosenRestitution(motion(), blocks).of(0, 1, {}), 0.0);
}

TEST(ChosenRestitution, WhatIsGivenComesFirst) {
  const std::vector<BlockSummary> blocks = {stone(), stone()};
  SceneJointLaw law;
  law.restitution = 0.3;
  EXPECT_EQ(ChosenRestitution(motion(), blocks).of(0, 1, law), 0.3);
  law.restitution = std::optional<double>();  // "springs"
  EXPECT_EQ(ChosenRestitution(motion(), blocks).of(0, 1, law), std::nullopt);
  law.restitution.reset();
  law.damping = 0.1;
  EXPECT_EQ(ChosenRestitution(motion(), blocks).of(0, 1, law), std::nullopt) << "dashpots have the loss";
}

TEST(ChosenRestitution, SpringsReboundWhereAStepResolvesThem) {
  const std::vector<BlockSummary> blocks = {stone(), stone()};
  SceneJointLaw law;
  // w = sqrt(k A / m): k = 2.5e8 Pa/m gives 316 1/s, 0.316 in a step.
  law.normal_stiffness = 2.5e8;
  EXPECT_EQ(ChosenRestitution(motion(), blocks).of(0, 1, law), 0.0);
  law.normal_stiffness = 2.0e8;
  EXPECT_EQ(ChosenRestitution(motion(), blocks).of(0, 1, law), std::nullopt);
  Scene points = motion();
  points.contact.springs = SceneContact::Springs::point;
  law.normal_stiffness = 2.0e8;  // N/m, the same for 1 m^2
  EXPECT_EQ(ChosenRestitution(points, blocks).of(0, 1, law), std::nullopt);
}

TEST(ChosenRestitution, ABlockThatDeformsOverManyStepsReboundsByItself) {
  std::vector<BlockSummary> blocks = {stone(), stone()};
  blocks[1].slowest_vibration = 140.0;
  EXPECT_EQ(ChosenRestitution(motion(), blocks).of(0, 1, {}), std::nullopt);
  blocks[1].slowest_vibration = 160.0;
  EXPECT_EQ(ChosenRestitution(motion(), blocks).of(0, 1, {}), 0.0);
}

TEST(ChosenRestitution, StaticsAndTheIncrementalFormulationHaveNone) {
  const std::vector<BlockSummary> blocks = {stone(), stone()};
  Scene scene = motion();
  scene.analysis.formulation = SceneAnalysis::Formulation::incremental;
  EXPECT_EQ(ChosenRestitution(scene, blocks).of(0, 1, {}), std::nullopt);
  scene = motion();
  scene.analysis.type = SceneAnalysis::Type::statics;
  EXPECT_EQ(ChosenRestitution(scene, blocks).of(0, 1, {}), std::nullopt);
}

}  // namespace
}  // namespace ashlar::chosen_restitution_test

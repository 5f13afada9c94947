#include "apps/scene/model/scene.hpp"

#include <gtest/gtest.h>

namespace ashlar::test::scene_test {
namespace {

Scene scene_with_joints() {
  Scene scene;
  scene.contact.law.friction_angle = 30.0;
  scene.contact.law.normal_stiffness = 1e9;
  scene.contact.law.cohesion = 7.0;
  SceneJoint all, special;
  all.blocks = {"*", "*"};
  all.friction_angle = 20.0;
  special.blocks = {"A", "B*"};
  special.friction_angle = 10.0;
  special.normal_stiffness.emplace(std::nullopt);
  special.tied = true;
  scene.joint = {all, special};
  return scene;
}

TEST(Scene, LastMatchingJointWinsKeyByKey) {
  const SceneJointLaw law = joint_law_between(scene_with_joints(), "B1", "A");
  EXPECT_EQ(law.friction_angle, 10.0);
  EXPECT_FALSE(law.normal_stiffness.has_value());  // given as "auto"
  EXPECT_EQ(law.cohesion, 7.0);                    // from [contact]
  EXPECT_TRUE(law.tied);
}

TEST(Scene, OtherPairsKeepWhatMatchesThem) {
  const SceneJointLaw law = joint_law_between(scene_with_joints(), "B1", "B2");
  EXPECT_EQ(law.friction_angle, 20.0);
  EXPECT_EQ(law.normal_stiffness, 1e9);
  EXPECT_FALSE(law.tied);
}

TEST(Scene, AJointGivesAnotherValueOrNone) {
  SceneJointLaw law;
  law.normal_stiffness = 1e9;
  law.restitution.emplace(0.3);
  SceneJoint joint;
  joint.compressive_strength = 1e7;
  override_law(law, joint);
  EXPECT_EQ(law.normal_stiffness, 1e9);
  EXPECT_EQ(law.restitution, std::optional<double>(0.3));
  EXPECT_EQ(law.compressive_strength, 1e7);
  // "auto" and "springs" are values too.
  joint.normal_stiffness.emplace(std::nullopt);
  joint.restitution.emplace(std::nullopt);
  override_law(law, joint);
  EXPECT_FALSE(law.normal_stiffness.has_value());
  ASSERT_TRUE(law.restitution.has_value());
  EXPECT_FALSE(law.restitution->has_value());
}

TEST(Scene, JointsOfCutsDoNotChooseMultipliers) {
  Scene scene = scene_with_joints();
  scene.analysis.type = SceneAnalysis::Type::statics;
  EXPECT_TRUE(has_multipliers(scene)) << "a joint of automatic stiffness beside a given one";
  scene.joint[1].made_by_cut = true;
  EXPECT_FALSE(has_multipliers(scene));
}

TEST(Scene, FindsMaterialsByName) {
  Scene scene;
  scene.material.resize(2);
  scene.material[0].name = "rock";
  scene.material[1].name = "soil";
  EXPECT_EQ(find_material(scene, "soil"), &scene.material[1]);
  EXPECT_EQ(find_material(scene, "Soil"), nullptr);
}

}  // namespace
}  // namespace ashlar::test::scene_test

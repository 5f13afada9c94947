#include "apps/scene/model/joint_table.hpp"

#include <gmock/gmock.h>

#include <random>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::joint_table_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Scene scene_of(const std::vector<std::string>& names, const std::vector<std::array<std::string, 2>>& joints) {
  Scene scene;
  for (const std::string& name : names) scene.block.emplace_back().name = name;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    SceneJoint joint;
    joint.blocks = joints[k];
    joint.friction_angle = static_cast<double>(k);
    scene.joint.push_back(joint);
  }
  return scene;
}

TEST(JointTable, FindsWhatMatchesInFileOrder) {
  const Scene scene =
      scene_of({"A", "B1", "B2"}, {{"*", "*"}, {"B*", "A"}, {"B1", "B1"}, {"C", "A"}, {"B?", "B[12]"}});
  const JointTable table(scene);
  EXPECT_THAT(table.joints_between(0, 1), ElementsAre(0, 1));
  EXPECT_THAT(table.joints_between(1, 0), ElementsAre(0, 1));
  EXPECT_THAT(table.joints_between(1, 2), ElementsAre(0, 4));
  EXPECT_EQ(table.law_between(0, 2).friction_angle, 1.0);
  EXPECT_TRUE(table.matches_a_pair(0));
  EXPECT_FALSE(table.matches_a_pair(2));
  EXPECT_FALSE(table.matches_a_pair(3));
  EXPECT_TRUE(table.matches_a_pair(4));
  EXPECT_THAT(table.matched(3, 0), IsEmpty());
  EXPECT_THAT(table.matched(1, 0), ElementsAre(1, 2));
}

TEST(JointTable, AgreesWithAskingEveryJoint) {
  std::mt19937 random(7);
  const std::vector<std::string> globs = {"*", "a*", "b?", "[ab]1", "a1", "b2", "c", "?1", "a\\*", "nothing"};
  const auto any_glob = [&] { return globs[random() % globs.size()]; };
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<std::array<std::string, 2>> joints;
    for (int k = 0; k < 12; ++k) joints.push_back({any_glob(), any_glob()});
    const Scene scene = scene_of({"a1", "a2", "b1", "b2", "c", "a*"}, joints);
    const JointTable table(scene);
    for (std::size_t a = 0; a < scene.block.size(); ++a) {
      for (std::size_t b = 0; b < scene.block.size(); ++b) {
        if (a == b) continue;
        EXPECT_EQ(table.law_between(a, b).friction_angle,
                  joint_law_between(scene, scene.block[a].name, scene.block[b].name).friction_angle);
      }
    }
  }
}

}  // namespace
}  // namespace ashlar::test::joint_table_test

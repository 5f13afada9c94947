#include "apps/run/scene_difference.hpp"

#include <gmock/gmock.h>

#include "apps/scene/json/scene_json.hpp"
#include "unit/apps/run_fixture.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::scene_difference_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

nlohmann::ordered_json json_of(const std::vector<std::string>& overrides) {
  Diagnostics diagnostics;
  return to_json(parse_scene(sample(), "s.toml", overrides, diagnostics));
}

TEST(SceneDifference, NamesKeysWithBothValues) {
  const auto was = json_of({});
  EXPECT_THAT(scene_differences(was, json_of({})), IsEmpty());
  EXPECT_THAT(scene_differences(was, json_of({"analysis.end_time=2", "title=other"})), IsEmpty());
  EXPECT_THAT(scene_differences(was, json_of({"block.B.order=3", "contact.friction_angle=20"})),
              ElementsAre("contact.friction_angle (was 30.0, is 20.0)", "block.B.order (was 1, is 3)"));
  EXPECT_THAT(scene_differences(was, json_of({"joint.0.cohesion=5"})),
              ElementsAre("joint.0.cohesion (was not given, is 5.0)"));
}

TEST_F(RunCommand, AResumeOfAChangedSceneNamesTheKey) {
  ASSERT_EQ(run("out"), 0) << faults_;
  EXPECT_EQ(run("out", {"--resume", "--set", "contact.friction_angle=20"}), 2);
  EXPECT_THAT(faults_, HasSubstr("checkpoint of another scene"));
  EXPECT_THAT(faults_, HasSubstr("changed: contact.friction_angle (was 30.0, is 20.0)"));
  EXPECT_EQ(run("out", {"--resume", "--set", "title=renamed"}), 0) << faults_;
}

}  // namespace
}  // namespace ashlar::test::scene_difference_test

// `ashlar check --json`, for editors and scripts.
#include "apps/program/check_command.hpp"

#include <gmock/gmock.h>

#include "apps/results/text/json_text.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::check_command_test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

class CheckJson : public RunCommand {
 protected:
  Json checked(int status, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"check", scene_.string(), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(command(std::move(arguments)), status);
    EXPECT_EQ(faults_, "");
    return parse_json(printed_);
  }
};

TEST_F(CheckJson, OfAGoodSceneHasWhatItHoldsAndCosts) {
  const Json json = checked(0);
  EXPECT_EQ(json["good"], true);
  EXPECT_EQ(json["faults"], Json::array());
  EXPECT_EQ(json["blocks"], 2);
  EXPECT_EQ(json["materials"], 1);
  EXPECT_EQ(json["joints"], 0);
  EXPECT_EQ(json["measures"], 1);
  EXPECT_EQ(json["estimate"]["unknowns"], 12.0 + 30.0);  // orders 1 and 2
  EXPECT_EQ(json["estimate"]["near_pairs"], 1.0);
  EXPECT_GT(json["estimate"]["memory_bytes"], 0.0);
  EXPECT_EQ(json["notes"], Json::array());
}

TEST_F(CheckJson, HasFaultsWithTheirPlaces) {
  // The third line of the scene and a value in an argument; the first is a key of nobody's.
  std::string text = scene_text;
  text.replace(text.find("end_time"), 8, "end_tme ");
  write_text(scene_, text);
  const Json json = checked(2, {"--set", "block.A.order=-1"});
  EXPECT_EQ(json["good"], false);
  EXPECT_FALSE(json.contains("estimate"));
  bool in_file = false, in_argument = false;
  for (const Json& fault : json["faults"]) {
    EXPECT_EQ(fault["severity"], "error");
    const std::string message = fault["message"];
    if (message.find("end_tme") != std::string::npos) {
      in_file = true;
      EXPECT_THAT(fault["file"].get<std::string>(), HasSubstr(scene_.filename().string()));
      EXPECT_EQ(fault["line"], 3);
      EXPECT_EQ(fault["column"], 1);
    }
    if (fault.contains("argument")) {
      in_argument = true;
      EXPECT_EQ(fault["argument"], "--set block.A.order=-1");
      EXPECT_FALSE(fault.contains("line"));
    }
  }
  EXPECT_TRUE(in_file);
  EXPECT_TRUE(in_argument);
}

TEST_F(CheckJson, WarningsLeaveASceneGood) {
  // No friction at all is hardly meant.
  std::string text = scene_text;
  text.replace(text.find("friction_angle = 30"), 19, "");
  write_text(scene_, text);
  const Json json = checked(0);
  EXPECT_EQ(json["good"], true);
  ASSERT_FALSE(json["faults"].empty());
  EXPECT_EQ(json["faults"][0]["severity"], "warning");
}

TEST_F(CheckJson, ACrackIsBetweenFacesThatTouch) {
  const std::string crack = "[[measure]]\nname = \"bed\"\ncrack = { joints = [\"A\"], to = [\"B\"] }\n";
  write_text(scene_, scene_text + crack);
  EXPECT_EQ(checked(0)["good"], true);
  const Json apart = checked(2, {"--set", "block.A.box.min=[3, -0.25, 0.6]"});
  ASSERT_EQ(apart["faults"].size(), 1U);
  EXPECT_THAT(apart["faults"][0]["message"].get<std::string>(), HasSubstr("no faces of these blocks touch"));
}

TEST_F(CheckJson, AFileThatIsNotThereIsAFaultToo) {
  std::filesystem::remove(scene_);
  const Json json = checked(2);
  EXPECT_EQ(json["good"], false);
  ASSERT_EQ(json["faults"].size(), 1U);
}

}  // namespace
}  // namespace ashlar::check_command_test

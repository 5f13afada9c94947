// Names after a cut: those of pieces, and that of the block before it for all of them. Bodies around a hollow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::names_after_cuts_test {
namespace {

using ::testing::HasSubstr;

class NamesAfterCuts : public RunCommand {
 protected:
  /// @param arguments the command, then options
  int check(const std::string& more, std::vector<std::string> arguments = {"blocks", "--json"}) {
    write_text(scene_, R"(
analysis = { type = "static" }
contact = { friction_angle = 30 }
material = [{ name = "rock", density = 2500, young_modulus = 1e10, poisson_ratio = 0.2 }]
[[block]]
name = "floor"
fixed = true
box = { min = [-1, -1, -1], max = [31, 31, 0] }
[[block]]
name = "rock"
material = "rock"
box = { min = [0, 0, 0], max = [30, 30, 30] }
)" + more);
    arguments.insert(arguments.begin() + 1, scene_.string());
    return command(std::move(arguments));
  }
};

const std::string halves = R"([[cut]]
name = "halves"
blocks = ["rock"]
dip = 0
dip_direction = 0
point = [15, 15, 15]
number = 0
glued = true
)";

const std::string cavern = R"([[cut]]
name = "cavern"
blocks = ["rock"]
solid.box = { min = [10, 10, 10], max = [20, 20, 20] }
)";

// The lower piece on the floor under a force of 45 degrees has the tangent of this joint as its factor.
TEST_F(NamesAfterCuts, AJointOfTheBlockIsThatOfItsPieces) {
  const auto joint = [](const std::string& name) {
    return "[[joint]]\nblocks = [\"" + name + "\", \"floor\"]\nfriction_angle = 20\n";
  };
  const std::string loose = halves.substr(0, halves.find("glued"));
  ASSERT_EQ(check(loose + joint("rock"), {"blocks", "--json", "--removable", "1,0,-1"}), exit_status::done)
      << faults_;
  const auto blocks = nlohmann::json::parse(printed_).at("blocks");
  ASSERT_EQ(blocks.at(1).at("name"), "rock.1");
  EXPECT_NEAR(blocks.at(1).at("key").at("factor_of_safety"), std::tan(std::acos(-1.0) / 9.0), 1e-12);
  EXPECT_EQ(check(loose + joint("rack"), {"check"}), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("joint names no block (\"rack\"), did you mean"));
}

TEST_F(NamesAfterCuts, AStageRemovesAllPieces) {
  const auto stages = [](const std::string& name) {
    return "[[stage]]\nname = \"all\"\n[[stage]]\nname = \"none\"\nremove = [\"" + name + "\"]\n";
  };
  ASSERT_EQ(check(halves + stages("rock"), {"blocks", "--json", "--stage", "none"}), exit_status::done)
      << faults_;
  EXPECT_EQ(nlohmann::json::parse(printed_).at("count"), 1) << "the floor";
  EXPECT_EQ(check(halves + stages("rack"), {"check"}), exit_status::bad_input);
}

TEST_F(NamesAfterCuts, ABodyAroundAHollowIsToldWithItsRemedy) {
  EXPECT_EQ(check(cavern), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("cut leaves a body around a hollow"));
  EXPECT_THAT(faults_, HasSubstr("a [[cut]] by a plane through the hollow before this one is needed"));
  ASSERT_EQ(check(halves + cavern), exit_status::done) << faults_;
  EXPECT_EQ(nlohmann::json::parse(printed_).at("volume"), 27000.0 + 32 * 32);
}

}  // namespace
}  // namespace ashlar::names_after_cuts_test

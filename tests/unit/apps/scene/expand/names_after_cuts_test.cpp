// What may be named after a cut: the pieces, and the block before it for all of them. Bodies around a hollow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::names_after_cuts_test {
namespace {

using ::testing::HasSubstr;

class NamesAfterCuts : public RunCommand {
 protected:
  int check(const std::string& more, const char* how = "blocks") {
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
    const bool checks = std::string(how) == "check";
    return checks ? command({how, scene_.string()}) : command({how, scene_.string(), "--json"});
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

TEST_F(NamesAfterCuts, AJointOfTheBlockIsThatOfItsPieces) {
  EXPECT_EQ(check(halves + "[[joint]]\nblocks = [\"rock\", \"floor\"]\nfriction_angle = 20\n", "check"),
            exit_status::done)
      << faults_;
  EXPECT_EQ(check(halves + "[[joint]]\nblocks = [\"rack\", \"floor\"]\nfriction_angle = 20\n", "check"),
            exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("joint names no block (\"rack\"), did you mean"));
}

TEST_F(NamesAfterCuts, AStageRemovesAllPieces) {
  EXPECT_EQ(check(halves + "[[stage]]\nname = \"all\"\n[[stage]]\nname = \"none\"\nremove = [\"rock\"]\n"),
            exit_status::done)
      << faults_;
}

TEST_F(NamesAfterCuts, ABodyAroundAHollowIsToldWithItsRemedy) {
  EXPECT_EQ(check(cavern), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("cut leaves a body around a hollow"));
  EXPECT_THAT(faults_, HasSubstr("a [[cut]] by a plane through the hollow before this one is needed"));
  ASSERT_EQ(check(halves + cavern), exit_status::done) << faults_;
  EXPECT_EQ(nlohmann::json::parse(printed_.substr(printed_.find("{"))).at("volume"), 27000.0 + 32 * 32);
}

}  // namespace
}  // namespace ashlar::names_after_cuts_test

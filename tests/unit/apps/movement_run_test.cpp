// `ashlar run` of scenes whose supports are moved (analysis.movement).
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::movement_run_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Two rigid blocks side by side between walls: half span 2 m, depth 0.5 m.
std::string flat_arch(const std::string& movement, const std::string& contact = "friction_angle = 45") {
  return "[analysis]\ntype = \"thrust\"\n" + movement + "\n[contact]\n" + contact + "\n" + rock_text +
         R"toml([[block]]
name = "left"
material = "rock"
order = 0
box = { min = [-2, 0, 0], max = [0, 1, 0.5] }
[[block]]
name = "right"
material = "rock"
order = 0
box = { min = [0, 0, 0], max = [2, 1, 0.5] }
[[block]]
name = "wall.1"
fixed = true
box = { min = [-3, 0, -1], max = [-2, 1, 1] }
[[block]]
name = "wall.2"
fixed = true
box = { min = [2, 0, -1], max = [3, 1, 1] }
)toml";
}

class MovementRun : public RunCommand {
 protected:
  nlohmann::json summary(const std::string& out) {
    return nlohmann::json::parse(text(out + "/summary.json"));
  }
};

TEST_F(MovementRun, BracketsTheMovementOfAWall) {
  write_text(scene_, flat_arch("movement = { supports = [\"wall.*\"], tolerance = 1e-4 }"));
  ASSERT_EQ(run("out"), 0) << faults_;
  const nlohmann::json found = summary("out");
  EXPECT_EQ(found.at("status"), "completed");
  ASSERT_EQ(found.at("thrust").size(), 2U);
  const double end = 2.0 * (std::hypot(2.0, 0.5) - 2.0);  // hinges in line
  for (const nlohmann::json& support : found.at("thrust")) {
    const nlohmann::json& out = support.at("movement").at("out");
    EXPECT_EQ(out.at("status"), "collapses");
    EXPECT_LE(out.at("lower").get<double>(), end + 1e-5);
    EXPECT_GE(out.at("upper").get<double>(), end - 1e-5);
    EXPECT_LE(out.at("upper").get<double>() - out.at("lower").get<double>(), 1e-4);
    EXPECT_NEAR(out.at("thrust").at(0).at(1).get<double>() / support.at("least").get<double>(), 1.0, 1e-5);
    EXPECT_EQ(out.at("joints").size(), 3U);
    EXPECT_EQ(out.at("moving"), (nlohmann::json{"left", "right"}));
    EXPECT_EQ(support.at("movement").at("in").at("status"), "jams");
    EXPECT_NEAR(std::abs(support.at("movement").at("direction").at(0).get<double>()), 1.0, 1e-9);
  }
  EXPECT_THAT(found.at("message").get<std::string>(),
              AllOf(HasSubstr("wall.1 can move 0.123"), HasSubstr("out (collapses at 0.123"),
                    HasSubstr("0 m in (jams"), Not(HasSubstr("slide"))));
  EXPECT_THAT(text("out/movement.svg"), AllOf(HasSubstr("<svg"), HasSubstr("support moved by 0.1231 m")));
}

TEST_F(MovementRun, IsOnlyWhereItIsAskedFor) {
  write_text(scene_, flat_arch(""));
  ASSERT_EQ(run("out"), 0) << faults_;
  EXPECT_FALSE(summary("out").at("thrust").at(0).contains("movement"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/movement.svg"));
}

TEST_F(MovementRun, SaysThatCohesionIsLeftOut) {
  write_text(scene_, flat_arch("movement = { supports = [\"wall.2\"], direction = [3, 0, 0], limit = 1e-3 }",
                               "friction_angle = 45\ncohesion = 1e3"));
  ASSERT_EQ(run("out"), 0) << faults_;
  EXPECT_THAT(summary("out").at("message").get<std::string>(),
              AllOf(HasSubstr("wall.2 can move 0.001 m along its direction (not limited as far as was tried"),
                    HasSubstr("by friction alone"), Not(HasSubstr("wall.1 can move"))));
}

TEST_F(MovementRun, RefusesWhatCannotBeMoved) {
  write_text(scene_, flat_arch("movement = { supports = [\"left\"] }"));
  EXPECT_EQ(run("out"), 2);
  EXPECT_THAT(faults_, AllOf(HasSubstr(":3:"), HasSubstr("movement names no support (\"left\")")));
  write_text(scene_, flat_arch("movement = { supports = [\"*\"], direction = [0, 0, 0] }"));
  EXPECT_EQ(run("out"), 2);
  EXPECT_THAT(faults_, AllOf(HasSubstr(":3:"), HasSubstr("direction has no direction")));
  write_text(scene_, flat_arch("movement = { supports = [\"*\"] }\ngravity = [0, 0, 0]"));
  EXPECT_EQ(run("out"), 2);
  EXPECT_THAT(faults_, HasSubstr("no load acts"));
  write_text(scene_, flat_arch("movement = { supports = [\"*\"], limit = 0 }"));
  EXPECT_EQ(run("out"), 2);
  EXPECT_THAT(faults_, HasSubstr("limit"));
}

}  // namespace
}  // namespace ashlar::movement_run_test

// `ashlar run` of scenes whose factor or thrust limit analysis finds.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::limit_run_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double degree = std::numbers::pi / 180.0;

class LimitRun : public RunCommand {
 protected:
  nlohmann::json summary(const std::string& out) {
    return nlohmann::json::parse(text(out + "/summary.json"));
  }
};

TEST_F(LimitRun, ThrustIsBoundedByFrictionEitherWay) {
  write_text(scene_, keystone("type = \"thrust\"", "friction_angle = 10"));
  ASSERT_EQ(run("out"), 0) << faults_;
  const nlohmann::json found = summary("out");
  EXPECT_EQ(found.at("status"), "completed");
  ASSERT_EQ(found.at("thrust").size(), 2U);
  const double half = 0.5 * 2000 * 9.81 * (1.0 + std::tan(30 * degree));
  for (const nlohmann::json& support : found.at("thrust")) {
    EXPECT_NEAR(support.at("least").get<double>() * std::tan(40 * degree) / half, 1.0, 1e-5);
    EXPECT_NEAR(support.at("most").get<double>() * std::tan(20 * degree) / half, 1.0, 1e-5);
    EXPECT_FALSE(support.at("least_line").empty());
  }
  EXPECT_THAT(found.at("message").get<std::string>(), HasSubstr("thrust on left between"));
  EXPECT_THAT(text("out/thrust.svg"), AllOf(HasSubstr("<svg"), HasSubstr("least thrust")));
}

TEST_F(LimitRun, ThrustOfWhatCannotStandSaysWhatMoves) {
  // Gravity lifts the stone out of its seat.
  write_text(scene_, keystone("type = \"thrust\"\ngravity = [0, 0, 9.81]", "friction_angle = 10"));
  ASSERT_EQ(run("out"), 0) << faults_;
  EXPECT_EQ(summary("out").at("status"), "moving");
  EXPECT_THAT(summary("out").at("message").get<std::string>(),
              AllOf(HasSubstr("nothing stands"), HasSubstr("stone")));
}

TEST_F(LimitRun, TheMethodFollowsTheJoints) {
  const std::string safety = "type = \"factor-of-safety\"\ngravity = [3, 0, -9.81]";
  write_text(scene_, keystone(safety, "friction_angle = 10"));
  ASSERT_EQ(run("limit"), 0) << faults_;
  const nlohmann::json found = summary("limit").at("factor_of_safety");
  EXPECT_EQ(found.at("method"), "limit");
  EXPECT_EQ(found.at("released"), found.at("lower"));
  for (const char* key :
       {"associated", "gap", "mode", "moving", "accelerations", "joints", "associated_motion"})
    EXPECT_TRUE(found.contains(key)) << key;
  EXPECT_THAT(found.at("kept_by_others"), IsEmpty());
  // A joint that loses strength is for static analyses, unless the scene says otherwise.
  const std::string brittle = "friction_angle = 10\nfriction_angle_residual = 9";
  write_text(scene_, keystone(safety + "\nsafety.upper = 1.5", brittle));
  ASSERT_EQ(run("auto"), 0) << faults_;
  EXPECT_EQ(summary("auto").at("factor_of_safety").at("method"), "elastic");
  EXPECT_FALSE(summary("auto").at("factor_of_safety").contains("limit"));
  EXPECT_THAT(faults_, AllOf(HasSubstr("warning: joints that lose strength fail point by point"),
                             HasSubstr("depends on the order")));
  ASSERT_EQ(run("forced", {"--set", "analysis.method=limit"}), 0) << faults_;
  EXPECT_EQ(summary("forced").at("factor_of_safety").at("method"), "limit");
}

TEST_F(LimitRun, JointsThatLoseStrengthHaveTheirResidual) {
  // A slab on a plane of 40 degrees with 38 degrees at the peak and 20 after failure: tan 20 / tan 40, and with
  // residual cohesion c by c A / (W sin 40) more, W = 2000 g, A = 4.
  const auto scene = [](const std::string& contact) {
    return "[analysis]\ntype = \"factor-of-safety\"\nmethod = \"limit\"\n"
           "gravity = [\"= 9.81*sin(40*deg)\", 0, \"= -9.81*cos(40*deg)\"]\n[contact]\n" +
           contact + R"(
[[material]]
name = "stone"
density = 2000
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "ground"
fixed = true
box = { min = [-4, -4, -1], max = [4, 4, 0] }
[[block]]
name = "slab"
material = "stone"
box = { min = [-1, -1, 0], max = [1, 1, 0.25] }
)";
  };
  const double friction = std::tan(20 * degree) / std::tan(40 * degree);
  const double cohesion = 4.0 * 500.0 / (2000 * 9.81 * std::sin(40 * degree));
  const std::string angles = "friction_angle = 38\nfriction_angle_residual = 20";
  for (const auto& [contact, factor] :
       {std::pair(angles, friction), std::pair(angles + "\ncohesion = 1e5", friction),
        std::pair(angles + "\ncohesion = 1e5\ncohesion_residual = 500", friction + cohesion)}) {
    write_text(scene_, scene(contact));
    ASSERT_EQ(run("out", {"--force"}), 0) << faults_;
    EXPECT_THAT(faults_,
                HasSubstr("s.toml:3:10: warning: joints lose strength when they fail: limit analysis has "
                          "their residual strength"));
    const nlohmann::json found = summary("out").at("factor_of_safety");
    EXPECT_EQ(found.at("strength"), "residual");
    EXPECT_LE(found.at("lower").get<double>(), factor * 1.001) << contact;
    EXPECT_GE(found.at("upper").get<double>(), factor * 0.999) << contact;
    EXPECT_THAT(summary("out").at("message").get<std::string>(), HasSubstr("by the residual strength"));
  }
  write_text(scene_, scene("friction_angle = 38"));
  ASSERT_EQ(run("out", {"--force"}), 0) << faults_;
  EXPECT_EQ(summary("out").at("factor_of_safety").at("strength"), "full");
}

TEST_F(LimitRun, StressOfTheGroundIsForStaticAnalyses) {
  write_text(scene_, keystone("type = \"factor-of-safety\"\nsafety.upper = 1.5", "friction_angle = 10") +
                         "[initial_stress]\nstress = [-1e5, 0, 0, 0, 0, 0]\n");
  static_cast<void>(run("auto"));
  EXPECT_EQ(summary("auto").at("factor_of_safety").at("method"), "elastic");
  ASSERT_EQ(run("forced", {"--set", "analysis.method=limit"}), 0) << faults_;
  EXPECT_EQ(summary("forced").at("factor_of_safety").at("method"), "limit");
  EXPECT_THAT(faults_, HasSubstr("limit analysis begins without it"));
}

TEST_F(LimitRun, ScenesWithNothingToFindAreRefused) {
  write_text(scene_, keystone("type = \"factor-of-safety\"", "friction_angle = 10"));
  EXPECT_EQ(run("fixed", {"--set", "block.stone.fixed=true"}), 2);
  EXPECT_THAT(faults_, HasSubstr("no block can move"));
  EXPECT_EQ(command({"check", scene_.string(), "--set", "block.stone.fixed=true"}), 2);
  EXPECT_THAT(faults_, HasSubstr("no block can move"));
  EXPECT_EQ(run("unloaded", {"--set", "analysis.type=capacity"}), 2);
  EXPECT_THAT(faults_, HasSubstr("names no load"));
}

TEST_F(LimitRun, ABlockWithoutContactIsNamed) {
  write_text(scene_, keystone("type = \"factor-of-safety\"", "friction_angle = 10") + R"(
[[block]]
name = "floating"
material = "rock"
box = { min = [0, 0, 5], max = [1, 1, 6] }
)");
  EXPECT_EQ(run("out"), 2);
  EXPECT_THAT(faults_, HasSubstr("block floating has no contact"));
}

}  // namespace
}  // namespace ashlar::limit_run_test

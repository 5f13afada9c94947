// Key blocks: their weight and the force that they need, supports, borders of the model, mechanisms with bolts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "apps/program/blocks/blocks_command.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::key_blocks_test {
namespace {

using ::testing::HasSubstr;

class KeyBlocks : public RunCommand {
 protected:
  /// `ashlar blocks` of a cube of 2000 kg on a slab, friction 30 degrees. @param more keys of the cube, and tables
  nlohmann::json blocks(const std::string& of_cube, const std::string& more,
                        std::vector<std::string> arguments, int expected = exit_status::done) {
    write_text(scene_, R"(
contact = { friction_angle = 30 }
analysis = { type = "factor-of-safety" }
material = [{ name = "rock", density = 2000, young_modulus = 1e10, poisson_ratio = 0.2 }]
[[block]]
name = "slab"
fixed = true
box = { min = [-2, -2, -1], max = [3, 3, 0] }
)" + more + R"([[block]]
name = "cube"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
)" + of_cube);
    arguments.insert(arguments.begin(), {"blocks", scene_.string(), "--json"});
    EXPECT_EQ(command(std::move(arguments)), expected) << faults_;
    return expected == exit_status::done ? nlohmann::json::parse(printed_) : nlohmann::json();
  }
};

const double weight = 2000 * 9.81, tangent = std::tan(std::acos(-1.0) / 6.0);

// Force along (1, 0, -1): thrust and pressure are both weight / sqrt(2).
TEST_F(KeyBlocks, ToldWithTheForceThatTheyNeed) {
  const double thrust = weight / std::sqrt(2.0);
  for (const double wanted : {1.0, 1.5}) {
    const nlohmann::json key = blocks("", "", {"--removable", "1,0,-1", "--wanted", std::to_string(wanted)})
                                   .at("blocks")[1]
                                   .at("key");
    EXPECT_NEAR(key.at("factor_of_safety"), tangent, 1e-12);
    EXPECT_NEAR(key.at("weight"), weight, 1e-9 * weight);
    EXPECT_NEAR(key.at("needed_force"), thrust * (1.0 - tangent / wanted), 1e-9 * thrust);
  }
}

TEST_F(KeyBlocks, ASupportAcrossTheMotionHolds) {
  const std::string roller =
      "fix = [{ plane = { point = [0, 0, 0], normal = [1, 0, 0] }, components = [\"x\"] }]\n";
  EXPECT_EQ(blocks(roller, "", {"--removable", "1,0,-1"}).at("blocks")[1].at("key").at("mode"), "stable");
  // Along y it is no support.
  const auto along = blocks(roller, "", {"--removable", "0,1,-1"}).at("blocks")[1].at("key");
  EXPECT_EQ(along.at("mode"), "sliding on one face");
  EXPECT_NEAR(along.at("factor_of_safety"), tangent, 1e-12);
}

// Walls on all sides but one, and a lid: what is left free may be a border of the model.
TEST_F(KeyBlocks, BordersOfTheModelAreNoFreeFaces) {
  std::string boxes;
  const auto box = [&](const char* name, const char* low, const char* high) {
    boxes += std::string("[[block]]\nname = \"") + name + "\"\nfixed = true\nbox = { min = " + low +
             ", max = " + high + " }\n";
  };
  box("back", "[-1, 0, 0]", "[0, 1, 1]");
  box("left", "[0, -1, 0]", "[1, 0, 1]");
  box("right", "[0, 1, 0]", "[1, 2, 1]");
  box("lid", "[0, 0, 1]", "[1, 1, 2]");
  const auto cube_of = [](const nlohmann::json& report) {
    for (const nlohmann::json& block : report.at("blocks"))
      if (block.at("name") == "cube") return block;
    return nlohmann::json();
  };
  EXPECT_TRUE(cube_of(blocks("", boxes, {"--removable", "1,0,-1"})).contains("key"));
  EXPECT_FALSE(cube_of(blocks("", boxes, {"--removable", "1,0,-1", "--border", "x=1"})).contains("key"));
  EXPECT_FALSE(cube_of(blocks("fix = [{ plane = { point = [1, 0, 0], normal = [1, 0, 0] } }]\n", boxes,
                              {"--removable", "1,0,-1"}))
                   .contains("key"));
}

// The bolt's dowel adds its strength, which is not divided: F = W cos tan / (W sin - S).
TEST_F(KeyBlocks, MechanismsHaveTheBolts) {
  const double share = weight / std::sqrt(2.0);
  for (const double strength : {0.0, 5000.0}) {
    const std::string bolt =
        "[[bolt]]\nname = \"b\"\nfrom = [0.5, 0.5, 0.8]\nto = [0.5, 0.5, -0.8]\narea = 1e-4\n"
        "yield_force = 1\nbond_stiffness = 1e9\nbond_strength = 1e5\nshear_stiffness = 1e8\n"
        "shear_strength = " +
        std::to_string(strength) + "\n";
    const auto report =
        blocks("", strength > 0.0 ? bolt : "", {"--removable", "1,0,-1", "--mechanisms", "5"});
    ASSERT_EQ(report.at("mechanisms").size(), 1U);
    const nlohmann::json& mechanism = report.at("mechanisms")[0];
    const double factor = share * tangent / (share - strength);
    EXPECT_EQ(mechanism.at("blocks"), std::vector<std::string>{"cube"});
    EXPECT_LE(mechanism.at("lower"), factor * (1 + 1e-3));
    EXPECT_GE(mechanism.at("upper"), factor * (1 - 1e-3));
    const auto force = mechanism.at("needed_force").get<std::vector<double>>();
    EXPECT_NEAR(force[0], -(share * (1.0 - tangent) - strength), 2e-3 * share);
  }
}

TEST_F(KeyBlocks, WithoutMechanismsTheFactorsTriedAreTold) {
  EXPECT_TRUE(blocks("", "", {"--removable", "0,0,-1", "--mechanisms", "5"}).at("mechanisms").empty());
  ASSERT_EQ(command({"blocks", scene_.string(), "--removable", "0,0,-1", "--mechanisms", "5", "--set",
                     "analysis.safety={ upper = 3 }"}),
            exit_status::done)
      << faults_;
  EXPECT_THAT(printed_,
              HasSubstr("0 mechanisms by limit analysis up to a factor of 3 (analysis.safety.upper)"));
}

TEST_F(KeyBlocks, FaultsAreTold) {
  blocks("", "", {"--removable", "1,0,-1", "--border", "w=1"}, exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("--border is no plane across an axis (w=1)"));
}

}  // namespace
}  // namespace ashlar::key_blocks_test

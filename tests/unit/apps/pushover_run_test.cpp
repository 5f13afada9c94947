// `ashlar run` of pushovers (analysis.type = "pushover").
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::pushover_run_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A rigid block of 0.5 m x 1 m x 2 m on the ground.
std::string standing(const std::string& keys, const std::string& more = "", const std::string& load = "") {
  return "[analysis]\ntype = \"pushover\"\n" + keys + "\n[contact]\nfriction_angle = 45\n" + rock_text +
         R"toml([[block]]
name = "block"
material = "rock"
order = 0
box = { min = [0, 0, 0], max = [0.5, 1, 2] }
)toml" + load +
         R"toml([[block]]
name = "ground"
fixed = true
box = { min = [-3, -3, -1], max = [4, 4, 0] }
[[measure]]
name = "top"
block = "block"
point = [0.5, 0.5, 2]
)toml" + more;
}

constexpr const char* load_text = "load = [{ force = [100, 0, 0], point = [0, 0.5, 2] }]\n";

class PushoverRun : public RunCommand {
 protected:
  nlohmann::json summary() { return nlohmann::json::parse(text("out/summary.json")); }
};

TEST_F(PushoverRun, WritesItsCurveAndItsCheck) {
  write_text(scene_, standing("pushover = { direction = [2, 0, 0], confidence_factor = 1 }\n"
                              "spectrum = { points = [[0, 1], [1, 1]] }",
                              "[output]\nfields = []\n", load_text));
  // The load is there all along, at twice the height of the centroid.
  ASSERT_EQ(run("out"), 0) << faults_;
  const nlohmann::json found = summary();
  EXPECT_EQ(found.at("status"), "completed");
  const double weight = 2000 * 9.81, first = (weight * 0.25 - 100.0 * 2.0) / weight;
  EXPECT_EQ(found.at("pushover").at("status"), "zero");
  EXPECT_NEAR(found.at("pushover").at("multiplier").get<double>(), first, 1e-6);
  EXPECT_NEAR(found.at("kinematic").at("a0_star").get<double>(), first * 9.81, 1e-5);
  EXPECT_EQ(found.at("pushover").at("mechanisms").at(0).at("moving"), (nlohmann::json{"block"}));
  EXPECT_THAT(found.at("message").get<std::string>(),
              AllOf(HasSubstr("block block moves"), HasSubstr("zero after"), HasSubstr("check ")));
  const std::vector<double> displacement = column("out/pushover.csv", "displacement");
  const std::vector<double> multiplier = column("out/pushover.csv", "multiplier");
  ASSERT_GT(displacement.size(), 10U);
  EXPECT_EQ(displacement.front(), 0.0);
  EXPECT_NEAR(multiplier.back(), 0.0, 1e-6);
  EXPECT_THAT(text("out/pushover.svg"), AllOf(HasSubstr("<svg"), HasSubstr("polyline"), HasSubstr("</svg>")));
  EXPECT_THAT(text("out/kinematic.csv"), AllOf(HasSubstr("secant period,T_s,"), HasSubstr("verdict")));
  // A step for each state, with the blocks there.
  const nlohmann::json& states = found.at("states");
  ASSERT_GT(states.size(), 5U);
  const std::vector<double> top = column("out/history.csv", "top.ux");
  ASSERT_EQ(top.size(), states.size() + 1);
  EXPECT_GT(top.back(), 0.4);
  EXPECT_EQ(states.back().at("multiplier").get<double>(), multiplier.back());
}

TEST_F(PushoverRun, FindsTheWeakestOfSeveralDirections) {
  write_text(scene_, standing("pushover = { directions = 4, direction = [0, 1, 0] }"));
  ASSERT_EQ(run("out"), 0) << faults_;
  const nlohmann::json push = summary().at("pushover");
  ASSERT_EQ(push.at("directions").size(), 4U);
  EXPECT_NEAR(push.at("multiplier").get<double>(), 0.25, 1e-6);
  EXPECT_NEAR(std::abs(push.at("direction").at(0).get<double>()), 1.0, 1e-9);
  EXPECT_NEAR(push.at("directions").at(0).at("multiplier").get<double>(), 0.5, 1e-6);
  EXPECT_THAT(summary().at("message").get<std::string>(), HasSubstr("weakest of 4 directions"));
}

TEST_F(PushoverRun, ShowsItsControlAndGivenLoads) {
  write_text(scene_, standing("pushover = { direction = [1, 0, 0], control = \"top\", blocks = [\"block\"] }",
                              "", load_text));
  ASSERT_EQ(run("out"), 0) << faults_;
  const nlohmann::json found = summary();
  EXPECT_NEAR(found.at("pushover").at("multiplier").get<double>() * 100.0 * 2.0, 2000 * 9.81 * 0.25, 0.05);
  EXPECT_NEAR(found.at("pushover").at("displacement").get<double>(), 2.0 * 0.5 / std::hypot(0.5, 2.0), 1e-5);
  EXPECT_FALSE(found.contains("kinematic"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/kinematic.csv"));
}

TEST_F(PushoverRun, NamesWhatNoDisplacementEnds) {
  write_text(scene_, standing("pushover = { direction = [1, 0, 0], limit = 0.2 }"));
  ASSERT_EQ(run("out", {"--set", "contact.friction_angle=10"}), 0) << faults_;
  EXPECT_EQ(summary().at("pushover").at("status"), "reaches-limit");
  EXPECT_THAT(summary().at("message").get<std::string>(), HasSubstr("after 0.2 m, as far as was tried"));
  EXPECT_TRUE(summary().at("kinematic").at("du_star").is_null());
}

TEST_F(PushoverRun, NamesWhatCannotMove) {
  write_text(scene_, standing("pushover = { direction = [1, 0, 0] }",
                              "[[block]]\nname = \"wall\"\nfixed = true\n"
                              "box = { min = [0.5, -1, 0], max = [2, 2, 3] }\n"));
  ASSERT_EQ(run("out"), 0) << faults_;
  EXPECT_EQ(summary().at("pushover").at("status"), "immovable");
  EXPECT_THAT(summary().at("message").get<std::string>(), HasSubstr("no multiplier moves a block"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/pushover.csv"));
}

TEST_F(PushoverRun, RefusesWhatItCannotPush) {
  const auto refused = [this](const std::string& keys) {
    write_text(scene_, standing(keys));
    EXPECT_EQ(run("out"), 2) << keys;
    return faults_;
  };
  EXPECT_THAT(refused(""), HasSubstr("has no direction"));
  EXPECT_THAT(refused("pushover = { direction = [0, 0, 0] }"), HasSubstr("direction has no direction"));
  EXPECT_THAT(refused("pushover = { direction = [1, 0, 0], control = \"tip\" }"),
              AllOf(HasSubstr("no measure of a point or a block (\"tip\")"), HasSubstr("\"top\"")));
  EXPECT_THAT(refused("pushover = { direction = [1, 0, 0], blocks = [\"nothing\"] }"),
              HasSubstr("loads to multiply move no block"));
  EXPECT_THAT(refused("pushover = { direction = [1, 0, 0] }\ngravity = [0, 0, 0]"), HasSubstr("no gravity"));
  EXPECT_THAT(refused("pushover = { direction = [1, 0, 0], height = 3 }"),
              HasSubstr("height without building_height"));
  EXPECT_THAT(refused("pushover = { direction = [1, 0, 0] }\nspectrum = { code = \"ec8\", soil = \"A\" }"),
              HasSubstr("missing key (ag)"));
  EXPECT_THAT(refused("pushover = { direction = [1, 0, 0] }\nspectrum = { points = [[1, 1], [0, 1]] }"),
              HasSubstr("out of order or negative"));
  EXPECT_THAT(refused("pushover = { direction = [1, 0, 0] }\nspectrum = { damping = 5 }"),
              HasSubstr("spectrum has no source (none given), exactly one of points, file, code is needed"));
  EXPECT_THAT(refused("pushover = { direction = [1, 0, 0] }\nspectrum = { file = \"none.csv\" }"),
              HasSubstr("record cannot be read"));
}

TEST_F(PushoverRun, WarnsOfItsKeysElsewhere) {
  write_text(scene_, standing("pushover = { direction = [1, 0, 0] }\nspectrum = { points = [[0, 1]] }"));
  ASSERT_EQ(command({"check", scene_.string(), "--set", "analysis.type=thrust"}), 0) << faults_;
  EXPECT_THAT(printed_ + faults_, AllOf(HasSubstr("pushover has no effect"),
                                        HasSubstr("spectrum has no effect"), Not(HasSubstr("error"))));
}

}  // namespace
}  // namespace ashlar::pushover_run_test

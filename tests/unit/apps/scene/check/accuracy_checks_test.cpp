#include "apps/scene/check/accuracy_checks.hpp"

#include <gmock/gmock.h>

#include "apps/scene/assemble/scene_reader.hpp"
#include "apps/scene/check/scene_checks.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::accuracy_checks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// A floor and two blocks, the second with an order of 3.
std::string scene_of(const std::string& analysis, const std::string& first = "",
                     const std::string& more = "") {
  return "analysis = { " + analysis + R"( }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
[[block]]
name = "A"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 1] }
)" + first +
         R"(
[[block]]
name = "B"
material = "stone"
order = 3
box = { min = [0, 0, 2], max = [1, 1, 3] }
)" + more;
}

std::vector<std::string> faults_of(const std::string& text) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(text, "s.toml", {}, diagnostics);
  check_references(scene, diagnostics);
  return printed(diagnostics);
}

Scene read(const std::string& text) {
  Diagnostics diagnostics;
  Scene scene = parse_scene(text, "s.toml", {}, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  return scene;
}

TEST(AccuracyChecks, WhatIsNotGivenIsAutomatic) {
  const Scene scene = read(scene_of("end_time = 2, accuracy = 1e-2"));
  EXPECT_TRUE(scene.analysis.automatic_step);
  EXPECT_EQ(scene.analysis.time_step, 2.0 / automatic_steps);
  EXPECT_TRUE(scene.block[0].automatic_order);
  EXPECT_EQ(scene.block[0].order, 1);
  EXPECT_FALSE(scene.block[1].automatic_order);
  EXPECT_EQ(scene.block[1].order, 3);
}

TEST(AccuracyChecks, WhatIsGivenStays) {
  const Scene scene = read(scene_of("end_time = 2, time_step = 0.1, accuracy = 1e-2", "order = 2"));
  EXPECT_FALSE(scene.analysis.automatic_step);
  EXPECT_EQ(scene.analysis.time_step, 0.1);
  EXPECT_FALSE(scene.block[0].automatic_order);
}

TEST(AccuracyChecks, AutoIsAsGoodAsNothing) {
  const Scene scene = read(scene_of("end_time = 2, time_step = \"auto\", accuracy = 1e-2", "order = \"auto\"",
                                    "[[assign]]\nblocks = [\"B\"]\norder = \"auto\"\n"));
  EXPECT_TRUE(scene.analysis.automatic_step);
  EXPECT_TRUE(scene.block[0].automatic_order);
  EXPECT_TRUE(scene.block[1].automatic_order);
  EXPECT_EQ(scene.block[1].order, 1);
}

TEST(AccuracyChecks, WithoutAccuracyNothingIsAutomatic) {
  const Scene scene = read(scene_of("end_time = 2, time_step = 0.1"));
  EXPECT_FALSE(scene.analysis.automatic_step);
  EXPECT_FALSE(scene.block[0].automatic_order);
  EXPECT_THAT(faults_of(scene_of("end_time = 2, time_step = 0.1", "order = \"auto\"")),
              ElementsAre(StartsWith("s.toml:7:9: error: order = \"auto\" without analysis.accuracy")));
  EXPECT_THAT(faults_of(scene_of("end_time = 2")), ElementsAre(HasSubstr("missing key (time_step)")));
  EXPECT_THAT(faults_of(scene_of("end_time = 2, time_step = \"auto\"")),
              ElementsAre(StartsWith("s.toml:1:40: error: time_step = \"auto\" without analysis.accuracy")));
}

TEST(AccuracyChecks, AValueIsANumberOrAuto) {
  EXPECT_THAT(faults_of(scene_of("end_time = 2, accuracy = 1e-2", "order = \"high\"")),
              ElementsAre(HasSubstr("a whole number from 0 to 12 or \"auto\" is needed")));
  EXPECT_THAT(faults_of(scene_of("end_time = 2, time_step = 0.1, accuracy = 0")),
              ElementsAre(HasSubstr("out of range (0)")));
  EXPECT_THAT(faults_of(scene_of("end_time = 2, time_step = 0.1, accuracy = 1.5")),
              ElementsAre(HasSubstr("out of range (1.5)")));
}

TEST(AccuracyChecks, SomeAnalysesHaveNone) {
  EXPECT_THAT(faults_of(scene_of("type = \"factor-of-safety\", accuracy = 0.1")),
              ElementsAre(HasSubstr("accuracy of a search (type = \"factor-of-safety\")")));
  EXPECT_THAT(faults_of(scene_of("end_time = 1, time_step = 0.1, accuracy = 0.1", "",
                                 "[[stage]]\nname = \"one\"\n[[stage]]\nname = \"two\"\n")),
              ElementsAre(HasSubstr("accuracy of an analysis with stages (2)")));
  EXPECT_THAT(faults_of(scene_of("end_time = 1, time_step = 0.1, accuracy = 0.1, formulation = \"paper\"")),
              ElementsAre(HasSubstr("accuracy of incremental blocks (0.1)")));
}

// Ground beyond a boundary is computed beforehand, with the step.
TEST(AccuracyChecks, BoundariesNeedAGivenStep) {
  const std::string boundary =
      "[[boundary]]\nplane = { point = [0, 0, 0], normal = [0, 0, -1] }\nkind = \"quiet\"\n";
  EXPECT_THAT(faults_of(scene_of("end_time = 1, accuracy = 0.1", "", boundary)),
              ElementsAre(HasSubstr("boundary beside an automatic time_step")));
  EXPECT_THAT(faults_of(scene_of("end_time = 1, time_step = 0.1, accuracy = 0.1", "", boundary)), IsEmpty());
}

TEST(AccuracyChecks, JsonSaysWhatIsAutomatic) {
  const std::string text = scene_of("end_time = 2, accuracy = 1e-2");
  const auto json = to_json(read(text));
  EXPECT_EQ(json["analysis"]["accuracy"], 1e-2);
  EXPECT_EQ(json["analysis"]["time_step"], "auto");
  EXPECT_EQ(json["block"][0]["order"], "auto");
  EXPECT_EQ(json["block"][1]["order"], 3);
}

}  // namespace
}  // namespace ashlar::test::accuracy_checks_test

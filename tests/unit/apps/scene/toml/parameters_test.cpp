#include "apps/scene/toml/parameters.hpp"

#include <gmock/gmock.h>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::parameters_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string with_parameters(const std::string& parameters, int line, const std::string& replacement) {
  return sample_with(line, replacement) + "[parameters]\n" + parameters;  // from line 33 on
}

Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  Scene scene = parse_scene(text, "s.toml", overrides, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  return scene;
}

TEST(Parameters, StandInAnyNumber) {
  const std::string text = with_parameters("h = 0.25\nn = 3\nlong = \"= n*h\"\n", 20,
                                           "order = \"= n - 1\"\n"
                                           "box = { min = [0, 0, 0], max = [\"= 4*long\", 1, \"=2*h\"] }");
  const Scene scene = scene_of(text);
  EXPECT_EQ(scene.block[1].order, 2);
  EXPECT_EQ(std::get<SceneBox>(scene.block[1].shape).max, Vector3(3.0, 1.0, 0.5));
  EXPECT_EQ(std::get<SceneBox>(scene_of(text, {"parameters.h=0.5"}).block[1].shape).max,
            Vector3(6.0, 1.0, 1.0));
  EXPECT_EQ(scene_of(text, {"block.B.order== n"}).block[1].order, 3);
}

TEST(Parameters, AreFoundInAnyOrder) {
  const Scene scene =
      scene_of(with_parameters("a = \"= b + c\"\nb = \"= 2*c\"\nc = 0.01\n", 3, "time_step = \"=a\""));
  EXPECT_EQ(scene.analysis.time_step, 0.01 * 2 + 0.01);
}

TEST(Parameters, NamesBeginAsTheyLike) {
  EXPECT_EQ(scene_of(sample_with(27, "name = \"= h\"")).measure[0].name, "= h");
}

TEST(Parameters, FaultsAreAtTheCharacter) {
  EXPECT_THAT(
      reading_faults(sample_with(3, "time_step = \"= 0.01*dt\"")),
      ElementsAre(::testing::StartsWith("s.toml:3:21: error: time_step (\"= 0.01*dt\"): unknown name in a "
                                        "formula (dt), ")));
  EXPECT_THAT(reading_faults(sample_with(3, "time_step = \"= 1/(2 - 2)\"")),
              ElementsAre("s.toml:3:14: error: time_step (\"= 1/(2 - 2)\"): formula divides by zero, another "
                          "divisor is needed"));
  EXPECT_THAT(
      reading_faults(sample_with(3, "time_step = \"= 1 - 2\"")),
      ElementsAre(
          "s.toml:3:13: error: time_step is out of range (\"= 1 - 2\" = -1), a number > 0 or \"auto\" is "
          "needed"));
  EXPECT_THAT(
      reading_faults(sample_with(31, "every = \"= 5/2\"")),
      ElementsAre("s.toml:31:9: error: every is no whole number (\"= 5/2\" = 2.5), a whole number of at "
                  "least 1 is needed; round(...) makes one"));
  EXPECT_THAT(reading_faults(sample(), {"analysis.time_step== dt"}),
              ElementsAre(::testing::StartsWith("--set analysis.time_step== dt: error: time_step (\"= dt\"): "
                                                "unknown name")));
}

TEST(Parameters, FaultsOfTheirOwn) {
  EXPECT_THAT(reading_faults(with_parameters("a = \"= b\"\nb = \"= c + 1\"\nc = \"= a\"\nd = \"= a\"\n", 3,
                                             "time_step = \"= d\"")),
              ElementsAre("s.toml:33:5: error: circular definition of parameters (a -> b -> c -> a); give "
                          "one of them without the others"));
  EXPECT_THAT(
      reading_faults(with_parameters("a = \"= a\"\n", 0, "")),
      ElementsAre(::testing::StartsWith("s.toml:33:5: error: circular definition of parameters (a -> a)")));
  EXPECT_THAT(
      reading_faults(with_parameters("a = inf\nb = true\nsin = 1\nx-y = 2\n", 0, "")),
      ElementsAre("s.toml:33:5: error: a is not finite (inf), a number is needed",
                  "s.toml:34:5: error: b has the wrong type (true), a number or a formula in quotes (\"= "
                  "2*h\") is needed",
                  "s.toml:35:1: error: parameter has a name that is taken (sin), formulas know it as a "
                  "function",
                  "s.toml:36:1: error: parameter cannot be used in formulas (x-y), a letter, then letters, "
                  "digits and _ are allowed"));
  EXPECT_THAT(
      reading_faults(with_parameters("a = \"= 1/0\"\nb = \"= a\"\n", 3, "time_step = \"= b + a\"")),
      ElementsAre(::testing::StartsWith("s.toml:33:6: error: a (\"= 1/0\"): formula divides by zero")));
  EXPECT_THAT(reading_faults("parameters = 3\n" + sample()),
              ElementsAre("s.toml:1:14: error: parameters has the wrong type (3), a table is needed"));
}

}  // namespace
}  // namespace ashlar::test::parameters_test

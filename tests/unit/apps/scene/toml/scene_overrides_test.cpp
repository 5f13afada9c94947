#include "apps/scene/toml/scene_overrides.hpp"

#include <gmock/gmock.h>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::scene_overrides_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

Scene overridden(const std::vector<std::string>& overrides) {
  Diagnostics diagnostics;
  Scene scene = parse_scene(sample(), "s.toml", overrides, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  return scene;
}

TEST(SceneOverrides, ReplacesKeysByPathNameAndIndex) {
  const Scene scene = overridden({"analysis.end_time=5", "block.B.order=3", "block.0.order=2",
                                  "material.rock.young_modulus=2e9", "block.B.fix.0.components=[\"z\"]"});
  EXPECT_EQ(scene.analysis.end_time, 5.0);
  EXPECT_EQ(scene.block[0].order, 2);
  EXPECT_EQ(scene.block[1].order, 3);
  EXPECT_EQ(scene.material[0].young_modulus, 2e9);
  EXPECT_EQ(scene.block[1].fix[0].components, (std::array<bool, 3>{false, false, true}));
}

TEST(SceneOverrides, TakesBareWordsAsTexts) {
  EXPECT_EQ(overridden({"title=two words, one \"quoted\" \\"}).title, "two words, one \"quoted\" \\");
  EXPECT_EQ(overridden({"analysis.integrator=average-acceleration"}).analysis.integrator,
            SceneAnalysis::Integrator::average_acceleration);
  EXPECT_EQ(overridden({"title='in TOML quotes'"}).title, "in TOML quotes");
}

TEST(SceneOverrides, LastOneWins) {
  EXPECT_EQ(overridden({"analysis.end_time=5", "analysis.end_time = 6"}).analysis.end_time, 6.0);
}

TEST(SceneOverrides, MakesMissingTablesAndReachesIntoArrays) {
  const Scene scene =
      overridden({"block.A.rotate.axis=[0,0,1]", "block.A.rotate.angle=90", "measure.tip.point.2=0.25"});
  EXPECT_EQ(scene.block[0].rotate->angle, 90.0);
  EXPECT_EQ(scene.measure[0].point, Vector3(4, 0.5, 0.25));
}

TEST(SceneOverrides, TakesThePlaceOfExcludedKeys) {
  const Scene scene =
      overridden({"output.interval=0.5", "block.A.sphere.radius=2", "block.B.load.0.force=[1,2,3]"});
  EXPECT_FALSE(scene.output.every.has_value());
  EXPECT_EQ(scene.output.interval, 0.5);
  EXPECT_EQ(std::get<SceneSphere>(scene.block[0].shape).radius, 2.0);
  EXPECT_EQ(scene.block[1].load[0].kind, SceneLoad::Kind::force);
}

TEST(SceneOverrides, NameGoesBeforeIndex) {
  const Scene scene = overridden({"block.B.name=\"0\"", "block.0.order=4"});
  EXPECT_EQ(scene.block[0].order, 1);
  EXPECT_EQ(scene.block[1].order, 4);
}

struct OverrideCase {
  std::string override_text;
  std::string expected;
  friend void PrintTo(const OverrideCase& fault, std::ostream* stream) { *stream << fault.override_text; }
};

class SceneOverrideFault : public ::testing::TestWithParam<OverrideCase> {};

TEST_P(SceneOverrideFault, IsReportedAtTheArgument) {
  const OverrideCase& fault = GetParam();
  EXPECT_THAT(reading_faults(sample(), {fault.override_text}),
              ElementsAre(StartsWith("--set " + fault.override_text + ": error: " + fault.expected)));
}

INSTANTIATE_TEST_SUITE_P(
    All, SceneOverrideFault,
    ::testing::Values(
        OverrideCase{"analysis.end_time", "no = (analysis.end_time), key.path=value is needed"},
        OverrideCase{"=5", "malformed key"}, OverrideCase{"analysis.end_time=", "no value"},
        OverrideCase{"analysis..end_time=5", "malformed key"},
        OverrideCase{"analysis.gravity=[0, 0", "malformed value"},
        OverrideCase{"analysis.end_tme=5", "unknown key in analysis (end_tme), did you mean end_time?"},
        OverrideCase{"outptu.every=5", "unknown key (outptu), did you mean output?"},
        OverrideCase{"analysis.end_time=-5", "end_time is out of range (-5), a number > 0 is needed"},
        OverrideCase{"analysis.end_time=soon", "end_time has the wrong type (\"soon\")"},
        OverrideCase{"analysis.end_time.x=5", "analysis.end_time has no keys (1.0), a table is needed"},
        OverrideCase{"block.C.order=2", "no such entry of block (C), an index from 0 to 1 or one of A, B"},
        OverrideCase{"block.2.order=2", "no such entry of block (2)"},
        OverrideCase{"block.B.order=99",
                     "order is out of range (99), a whole number from 0 to 12 or \"auto\" is needed"},
        OverrideCase{"material.rock.density=-1", "density is out of range (-1)"},
        OverrideCase{"measure.tip.point.3=1",
                     "no such entry of measure.tip.point (3), an index from 0 to 2 is needed"},
        OverrideCase{"measure.tip.point.1=nan", "point is not finite (nan)"}));

TEST(SceneOverrides, OneArgumentSetsOneKey) {
  EXPECT_THAT(reading_faults(sample(), {"analysis.end_time=1\ntitle=2"}),
              ElementsAre(StartsWith("--set analysis.end_time=1 title=2: error: several keys")));
}

}  // namespace
}  // namespace ashlar::test::scene_overrides_test

#include "apps/scene/check/boundary_checks.hpp"

#include <gmock/gmock.h>

#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::boundary_checks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Two boxes on each other, 4 x 2 x 1 m each.
const std::string ground = R"([analysis]
end_time = 1
time_step = 0.01
initial_state = "static"
[contact]
friction_angle = 30
[[material]]
name = "rock"
density = 2500
young_modulus = 1e9
poisson_ratio = 0.25
[[block]]
name = "low"
material = "rock"
box = { min = [0, 0, 0], max = [4, 2, 1] }
[[block]]
name = "high"
material = "rock"
box = { min = [0, 0, 1], max = [4, 2, 2] }
)";

std::string boundary(const std::string& point, const std::string& normal, const std::string& more,
                     const std::string& kind = "quiet") {
  return "[[boundary]]\nplane = { point = " + point + ", normal = " + normal + " }\nkind = \"" + kind +
         "\"\n" + more;
}
const std::string base = boundary("[0, 0, 0]", "[0, 0, -2]", "");

std::vector<std::string> faults_of(const std::string& more, const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  (void)load_scene_text(ground + more, "s.toml", overrides, diagnostics);
  return printed(diagnostics);
}

TEST(BoundaryChecks, AQuietBaseWithAWaveIsFine) {
  EXPECT_THAT(faults_of(base + "wave = [[0, 0, 0, 0], [1, 0.1, 0, 0], [2, 0, 0, 0]]"), IsEmpty());
}

TEST(BoundaryChecks, APlaneMeetsOuterFacesOfMovingBlocks) {
  EXPECT_THAT(faults_of(boundary("[0, 0, 0.5]", "[0, 0, -1]", "")),
              ElementsAre(AllOf(HasSubstr("error: boundary meets no face of a moving block"),
                                HasSubstr("point [0, 0, 0.5], normal [0, 0, -1]"))));
  EXPECT_THAT(faults_of(boundary("[0, 0, 0]", "[0, 0, 1]", "")),
              ElementsAre(HasSubstr("faces in this plane have the opposite normal")));
  EXPECT_THAT(faults_of(base, {"block.low.fixed=true"}),
              ElementsAre(HasSubstr("blocks in this plane are fixed")));
}

TEST(BoundaryChecks, AFaceHasOneBoundaryAndNoSupport) {
  EXPECT_THAT(faults_of(base + base),
              ElementsAre(HasSubstr("face of block \"low\" belongs to two boundaries")));
  const std::string fix = "[[assign]]\nblocks = [\"low\"]\n[[assign.fix]]\nplane = { point = ";
  EXPECT_THAT(faults_of(base + fix + "[0, 0, 0], normal = [0, 0, 1] }"),
              ElementsAre(HasSubstr("boundary at a face with a support (block \"low\")")));
  EXPECT_THAT(faults_of(base + fix + "[0, 0, 0], normal = [0, 1, 0] }\ncomponents = [\"y\"]"), IsEmpty());
  EXPECT_THAT(faults_of(base + fix +
                        "[0, 0, 0], normal = [0, 1, 0] }\nvelocity_history = [[0, 0, 0, 0], [1, 1, 0, 0]]"),
              ElementsAre(HasSubstr("boundary at a block with a moving support (\"low\")")));
}

TEST(BoundaryChecks, BlocksDeform) {
  EXPECT_THAT(
      faults_of(base, {"block.low.order=0"}),
      ElementsAre(HasSubstr("boundary at a rigid block (\"low\", order 0), order 1 or more is needed")));
  EXPECT_THAT(faults_of(base, {"analysis.formulation=paper", "analysis.initial_state=as-placed"}),
              ::testing::Contains(HasSubstr("a boundary of incremental blocks (formulation = \"paper\")")));
}

TEST(BoundaryChecks, AFreeFieldHasABaseLayersAndNoWave) {
  const std::string side = boundary("[0, 0, 0]", "[-1, 0, 0]", "", "free-field");
  EXPECT_THAT(faults_of(base + side), IsEmpty());
  EXPECT_THAT(faults_of(side), ElementsAre(HasSubstr("free-field without a quiet boundary at right angles")));
  EXPECT_THAT(
      faults_of(base + side + "wave = [[0, 0, 0, 0], [1, 0.1, 0, 0]]"),
      ElementsAre(HasSubstr("wave of a free-field boundary, it belongs to the quiet boundary below it")));
  EXPECT_THAT(faults_of(base + side, {"block.low.box.min=[1, 0, 0]"}),
              ElementsAre(HasSubstr(
                  "free-field has no column of ground beside it (its faces begin 1 m above the base)")));
  EXPECT_THAT(faults_of(base + side, {"block.high.translate=[0, 0, 0.5]"}),
              ElementsAre(HasSubstr("(no face is between 1 m and 1.5 m above the base)")));
}

TEST(BoundaryChecks, UnknownKindsAndLostDirectionsAreFaults) {
  EXPECT_THAT(faults_of(boundary("[0, 0, 0]", "[0, 0, -1]", "", "soft")),
              ElementsAre(AllOf(HasSubstr("kind"), HasSubstr("\"quiet\""), HasSubstr("\"free-field\""))));
  EXPECT_THAT(
      faults_of(base + "direction = [1, 0, 0]"),
      ElementsAre(HasSubstr("direction of no wave, it belongs to a wave from a file with one column")));
  EXPECT_THAT(faults_of(base + "direction = [1, 0, 0]\nwave = [[0, 0, 0, 0]]"),
              ElementsAre(HasSubstr("direction of rows with three components")));
  EXPECT_THAT(faults_of(base + "direction = [0, 0, 0]\nwave = [[0, 0, 0, 0]]"),
              ElementsAre(HasSubstr("direction has no direction")));
}

TEST(BoundaryChecks, AMotionWithoutRestIsWarnedOf) {
  EXPECT_THAT(faults_of(base, {"analysis.initial_state=as-placed"}),
              ElementsAre(HasSubstr("warning: boundary carries no weight at the start")));
  EXPECT_THAT(faults_of(base, {"analysis.initial_state=as-placed", "analysis.gravity=[0, 0, 0]"}), IsEmpty());
  EXPECT_THAT(faults_of(base + "wave = [[0, 0, 0, 0], [1, 0.1, 0, 0]]",
                        {"analysis.type=static", "analysis.initial_state=as-placed"}),
              ElementsAre(HasSubstr("warning: wave has no effect in a static analysis")));
}

TEST(BoundaryChecks, AWaveOfOneColumnHasADirection) {
  TemporaryFolder folder;
  const std::string text = ground + base + "wave = { file = \"w.csv\", time = \"t\", values = [\"v\"] }\n" +
                           "direction = [0, 3, 4]\n";
  write_text(folder / "w.csv", "t,v\n0,0\n1,5\n");
  Diagnostics diagnostics;
  const Scene scene = parse_scene(text, folder.path() / "s.toml", {}, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  ASSERT_EQ(scene.boundary[0].wave.size(), 2U);
  EXPECT_NEAR((scene.boundary[0].wave[1].value - Vector3(0, 3, 4)).norm(), 0.0, 1e-12);
  const auto json = to_json(scene)["boundary"][0];
  EXPECT_EQ(json["kind"], "quiet");
  EXPECT_EQ(json["wave"]["values"][0], "v");
  EXPECT_EQ(json["direction"][2], 4.0);
}

}  // namespace
}  // namespace ashlar::test::boundary_checks_test

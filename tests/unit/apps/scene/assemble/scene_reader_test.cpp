#include "apps/scene/assemble/scene_reader.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::scene_reader_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(SceneReader, ReadsEveryKeyOfTheSample) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(sample(), "s.toml", {}, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  EXPECT_EQ(scene.analysis.end_time, 1.0);
  EXPECT_EQ(scene.analysis.time_step, 0.01);
  EXPECT_EQ(scene.contact.law.friction_angle, 30.0);
  ASSERT_EQ(scene.joint.size(), 1u);
  EXPECT_EQ(scene.joint[0].blocks[1], "B*");
  ASSERT_EQ(scene.material.size(), 1u);
  EXPECT_EQ(scene.material[0].young_modulus, 1e9);
  ASSERT_EQ(scene.block.size(), 2u);
  EXPECT_EQ(scene.block[1].material, "rock");
  EXPECT_EQ(std::get<SceneBox>(scene.block[0].shape).max, Vector3(1, 1, 2));
  ASSERT_EQ(scene.block[1].fix.size(), 1u);
  EXPECT_EQ(std::get<ScenePlane>(scene.block[1].fix[0].where).normal, Vector3(-1, 0, 0));
  ASSERT_EQ(scene.block[1].load.size(), 1u);
  EXPECT_EQ(scene.block[1].load[0].kind, SceneLoad::Kind::traction);
  EXPECT_EQ(scene.block[1].load[0].vector, Vector3(0, 0, -1e5));
  ASSERT_EQ(scene.measure.size(), 1u);
  EXPECT_EQ(scene.measure[0].point, Vector3(4, 0.5, 0.5));
  EXPECT_EQ(scene.output.every, 5);
}

TEST(SceneReader, FillsInDefaults) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(sample_with(31, ""), "s.toml", {}, diagnostics);
  EXPECT_EQ(scene.analysis.integrator, SceneAnalysis::Integrator::dda);
  EXPECT_EQ(scene.analysis.gravity, Vector3(0, 0, -9.81));
  EXPECT_EQ(scene.contact.springs, SceneContact::Springs::area);
  EXPECT_FALSE(scene.contact.law.normal_stiffness.has_value());
  EXPECT_FALSE(scene.joint[0].friction_angle.has_value());
  EXPECT_EQ(scene.block[0].order, 1);
  EXPECT_EQ(scene.output.every, default_frame_distance);
  EXPECT_TRUE(scene.output.fields.stress);
  EXPECT_FALSE(scene.output.curved);
  EXPECT_EQ(scene.output.precision, SceneOutput::Precision::automatic);
}

TEST(SceneReader, ReadsEveryWordAndOptionalKey) {
  const std::string text = R"(
title = "all"
[analysis]
type = "static"
end_time = 2
time_step = 1
integrator = "generalized-alpha"
spectral_radius = 0.5
formulation = "incremental"
initial_state = "equilibrium"
gravity = [1, 2, 3]
solver = "cg"
mass_damping = 4
[contact]
springs = "point"
surface = "flat"
normal_stiffness = 5
shear_stiffness = "auto"
cohesion = 6
tensile_strength = 7
distance = 8
angle = 9
subdivisions = 2
augmented = true
penetration_tolerance = 1e-6
[[joint]]
blocks = ["a", "b"]
normal_stiffness = "auto"
shear_stiffness = 10
cohesion = 11
tied = true
[[material]]
name = "m"
density = 1
young_modulus = 1
poisson_ratio = 0
elasticity = "st-venant-kirchhoff"
[[block]]
name = "a"
material = "m"
sphere = { center = [1, 0, 0], radius = 2, subdivisions = 1 }
rotate = { axis = [0, 0, 1], angle = 30, about = [1, 1, 1] }
translate = [3, 0, 0]
velocity = [1, 0, 0]
angular_velocity = [0, 1, 0]
[[block.fix]]
point = [1, 2, 3]
components = ["x", "z"]
displacement_history = [[0, 0, 0, 0], [1, 0.1, 0, 0.3]]
[[block.load]]
point = [1, 2, 3]
force = [4, 5, 6]
history = [[0, 0], [0.1, 1]]
[[block]]
name = "b"
fixed = true
mesh = { file = "x.off", scale = 2 }
[[block]]
name = "c"
fixed = true
hull = { points = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]] }
[output]
interval = 0.25
fields = ["velocity"]
curved = true
precision = "double"
)";
  Diagnostics diagnostics;
  const Scene scene = parse_scene(text, "s.toml", {}, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  EXPECT_EQ(scene.title, "all");
  EXPECT_EQ(scene.analysis.type, SceneAnalysis::Type::statics);
  EXPECT_EQ(scene.analysis.integrator, SceneAnalysis::Integrator::generalized_alpha);
  EXPECT_EQ(scene.analysis.spectral_radius, 0.5);
  EXPECT_EQ(scene.analysis.formulation, SceneAnalysis::Formulation::incremental);
  EXPECT_EQ(scene.analysis.initial_state, SceneAnalysis::InitialState::equilibrium);
  EXPECT_EQ(scene.analysis.gravity, Vector3(1, 2, 3));
  EXPECT_EQ(scene.analysis.solver, SceneAnalysis::Solver::cg);
  EXPECT_EQ(scene.analysis.mass_damping, 4.0);
  EXPECT_EQ(scene.contact.springs, SceneContact::Springs::point);
  EXPECT_EQ(scene.contact.surface, SceneContact::Surface::flat);
  EXPECT_EQ(scene.contact.law.normal_stiffness, 5.0);
  EXPECT_FALSE(scene.contact.law.shear_stiffness.has_value());
  EXPECT_EQ(scene.contact.law.cohesion, 6.0);
  EXPECT_EQ(scene.contact.law.tensile_strength, 7.0);
  EXPECT_EQ(scene.contact.distance, 8.0);
  EXPECT_EQ(scene.contact.angle, 9.0);
  EXPECT_EQ(scene.contact.subdivisions, 2);
  EXPECT_TRUE(scene.contact.augmented);
  EXPECT_EQ(scene.contact.penetration_tolerance, 1e-6);
  ASSERT_TRUE(scene.joint.at(0).normal_stiffness.has_value());
  EXPECT_FALSE(scene.joint[0].normal_stiffness->has_value());
  EXPECT_EQ(*scene.joint[0].shear_stiffness, 10.0);
  EXPECT_EQ(scene.joint[0].tied, true);
  EXPECT_EQ(scene.material.at(0).elasticity, SceneMaterial::Elasticity::st_venant_kirchhoff);
  const SceneBlock& a = scene.block.at(0);
  EXPECT_EQ(std::get<SceneSphere>(a.shape).radius, 2.0);
  EXPECT_EQ(a.rotate->about, Vector3(1, 1, 1));
  EXPECT_EQ(a.translate, Vector3(3, 0, 0));
  EXPECT_EQ(a.angular_velocity, Vector3(0, 1, 0));
  EXPECT_EQ(std::get<Vector3>(a.fix.at(0).where), Vector3(1, 2, 3));
  EXPECT_EQ(a.fix[0].components, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(a.fix[0].history.at(1).value, Vector3(0.1, 0.0, 0.3));
  EXPECT_EQ(a.load.at(0).kind, SceneLoad::Kind::force);
  EXPECT_EQ(a.load[0].history.at(1).factor, 1.0);
  EXPECT_EQ(std::get<SceneMesh>(scene.block.at(1).shape).scale, 2.0);
  EXPECT_EQ(std::get<SceneHull>(scene.block.at(2).shape).points.at(3), Vector3(0, 0, 1));
  EXPECT_EQ(scene.output.interval, 0.25);
  EXPECT_TRUE(scene.output.curved);
  EXPECT_EQ(scene.output.precision, SceneOutput::Precision::of_double);
  EXPECT_FALSE(scene.output.every.has_value());
  EXPECT_FALSE(scene.output.fields.stress);
}

class SceneReaderFault : public ::testing::TestWithParam<FaultCase> {};

TEST_P(SceneReaderFault, IsReportedOnceAtItsPlace) {
  const FaultCase& fault = GetParam();
  EXPECT_THAT(reading_faults(sample_with(fault.line, fault.replacement)),
              ElementsAre(StartsWith(fault.expected)));
}

INSTANTIATE_TEST_SUITE_P(
    Analysis, SceneReaderFault,
    ::testing::Values(
        FaultCase{2, "", "s.toml:1:2: error: missing key (end_time), analysis needs it"},
        FaultCase{2, "end_time = 0",
                  "s.toml:2:12: error: end_time is out of range (0), a number > 0 is needed"},
        FaultCase{2, "end_time = -1", "s.toml:2:12: error: end_time is out of range (-1)"},
        FaultCase{2, "  end_time = \"1\"",
                  "s.toml:2:14: error: end_time has the wrong type (\"1\"), a number > 0"},
        FaultCase{2, "end_time = inf", "s.toml:2:12: error: end_time is not finite (inf)"},
        FaultCase{3, "time_step = nan", "s.toml:3:13: error: time_step is not finite (nan)"},
        FaultCase{3, "time_step = -1e-3", "s.toml:3:13: error: time_step is out of range (-0.001)"},
        FaultCase{3, "time_step = 1e-3\nintegrator = \"dd\"",
                  "s.toml:4:14: error: unknown integrator (\"dd\"), did you mean \"dda\"? one of \"dda\", "
                  "\"average-acceleration\", \"generalized-alpha\" is needed"},
        FaultCase{3, "time_step = 1e-3\ntype = 3", "s.toml:4:8: error: type has the wrong type (3), one of"},
        FaultCase{3, "time_step = 1e-3\nspectral_radius = 1.5",
                  "s.toml:4:19: error: spectral_radius is out of range"},
        FaultCase{3, "time_step = 1e-3\nmass_damping = -1",
                  "s.toml:4:16: error: mass_damping is out of range (-1)"},
        FaultCase{3, "time_step = 1e-3\ngravity = [0, -9.81]",
                  "s.toml:4:11: error: gravity has the wrong length (2 entries), [x, y, z] is needed"},
        FaultCase{3, "time_step = 1e-3\ngravity = [0, 0, nan]",
                  "s.toml:4:18: error: gravity is not finite (nan)"},
        FaultCase{3, "time_step = 1e-3\ngravity = -9.81",
                  "s.toml:4:11: error: gravity has the wrong type (-9.81)"}));

INSTANTIATE_TEST_SUITE_P(
    Contact, SceneReaderFault,
    ::testing::Values(
        FaultCase{
            5, "friction_angle = 90",
            "s.toml:5:18: error: friction_angle is out of range (90), a number of degrees >= 0 and < 90"},
        FaultCase{5, "cohesion = -1", "s.toml:5:12: error: cohesion is out of range (-1)"},
        FaultCase{5, "allowed_overlap = -1e-4",
                  "s.toml:5:19: error: allowed_overlap is out of range (-0.0001)"},
        FaultCase{
            5, "fit = 2e-4",
            "s.toml:5:1: error: fit is no key any more, blocks stay as they are placed; allowed_overlap"},
        FaultCase{
            5, "normal_stiffness = 0",
            "s.toml:5:20: error: normal_stiffness is out of range (0), a number > 0 or \"auto\" is needed"},
        FaultCase{5, "shear_stiffness = \"aut\"",
                  "s.toml:5:19: error: shear_stiffness has the wrong type (\"aut\")"},
        FaultCase{5, "angle = 46", "s.toml:5:9: error: angle is out of range (46)"},
        FaultCase{5, "subdivisions = -1",
                  "s.toml:5:16: error: subdivisions is out of range (-1), a whole number from 0 to 8"},
        FaultCase{5, "chord_tolerance = 0.1\nsubdivisions = 2",
                  "s.toml:6:1: error: subdivisions beside chord_tolerance"},
        FaultCase{5, "augmented = \"no\"",
                  "s.toml:5:13: error: augmented has the wrong type (\"no\"), true or false"},
        FaultCase{5, "friction = 30",
                  "s.toml:5:1: error: unknown key in contact (friction), did you mean friction_angle?"},
        FaultCase{7, "", "s.toml:6:1: error: missing key (blocks), joint needs it"},
        FaultCase{7, "blocks = [\"A\"]", "s.toml:7:10: error: blocks has the wrong length (1 entries)"},
        FaultCase{7, "blocks = [\"A\", 2]", "s.toml:7:16: error: blocks has the wrong type (2), a text"},
        FaultCase{7, "blocks = [\"A\", \"B\"]\ntied = 1", "s.toml:8:8: error: tied has the wrong type (1)"}));

INSTANTIATE_TEST_SUITE_P(
    Material, SceneReaderFault,
    ::testing::Values(
        FaultCase{9, "name = 7",
                  "s.toml:9:8: error: name has the wrong type (7), a text in quotes is needed"},
        FaultCase{9, "name = \"\"", "s.toml:9:8: error: name cannot be used as a name (\"\")"},
        FaultCase{9, "name = \"a\\tb\"", "s.toml:9:8: error: name cannot be used as a name"},
        FaultCase{10, "density = -3600",
                  "s.toml:10:11: error: density is out of range (-3600), a number > 0 is needed"},
        FaultCase{10, "density = 0", "s.toml:10:11: error: density is out of range (0)"},
        FaultCase{10, "", "s.toml:8:1: error: missing key (density), material needs it"},
        FaultCase{11, "young_modulus = 0.0", "s.toml:11:17: error: young_modulus is out of range (0.0)"},
        FaultCase{11, "young_modulus = 1e9\nelasticity = \"plastic\"",
                  "s.toml:12:14: error: unknown elasticity (\"plastic\")"},
        FaultCase{
            12, "poisson_ratio = 0.5",
            "s.toml:12:17: error: poisson_ratio is out of range (0.5), a number >= 0 and < 0.5 is needed"},
        FaultCase{12, "poisson_ratio = -0.1", "s.toml:12:17: error: poisson_ratio is out of range (-0.1)"},
        FaultCase{12, "poisson_ratio = 0.2\nporosity = 0.1",
                  "s.toml:13:1: error: unknown key in material (porosity)"}));

INSTANTIATE_TEST_SUITE_P(
    MeasureAndOutput, SceneReaderFault,
    ::testing::Values(FaultCase{28, "", "s.toml:26:1: error: missing key (block), measure needs it"},
                      FaultCase{
                          31, "every = 0",
                          "s.toml:31:9: error: every is out of range (0), a whole number of at least 1"},
                      FaultCase{31, "every = -10", "s.toml:31:9: error: every is out of range (-10)"},
                      FaultCase{31, "every = 2.5", "s.toml:31:9: error: every has the wrong type (2.5)"},
                      FaultCase{31, "interval = 0", "s.toml:31:12: error: interval is out of range (0)"},
                      FaultCase{31, "every = 1\ninterval = 0.1", "s.toml:32:1: error: interval beside every"},
                      FaultCase{31, "fields = [\"stress\", \"strain\"]",
                                "s.toml:31:21: error: unknown fields (\"strain\")"},
                      FaultCase{31, "fields = [\"stress\", \"stress\"]",
                                "s.toml:31:21: error: fields names something twice"}));

INSTANTIATE_TEST_SUITE_P(
    Structure, SceneReaderFault,
    ::testing::Values(FaultCase{1, "gravity = [0, 0, 0]\n[analysis]",
                                "s.toml:1:1: error: unknown key (gravity), gravity belongs to analysis"},
                      FaultCase{1, "titel = \"x\"\n[analysis]",
                                "s.toml:1:1: error: unknown key (titel), did you mean title?"},
                      FaultCase{31, "every = 1\n[outputs]",
                                "s.toml:32:2: error: unknown key (outputs), did you mean output?"},
                      FaultCase{31, "every = 1\n[analysis.extra]",
                                "s.toml:32:11: error: unknown key in analysis (extra)"}));

TEST(SceneReader, MalformedTomlIsReportedAtItsPlace) {
  EXPECT_THAT(reading_faults("[analysis]\n  = 3\n"),
              ElementsAre(StartsWith("s.toml:2:3: error: malformed TOML")));
  EXPECT_THAT(reading_faults("a = 1\na = 2\n"), ElementsAre(StartsWith("s.toml:2:5: error: malformed TOML")));
  EXPECT_THAT(reading_faults("title = \"\xff\""),
              ElementsAre(StartsWith("s.toml:1:9: error: malformed TOML")));
}

TEST(SceneReader, KeysOfThousandsOfPartsAreRefused) {
  std::string key = "a";
  for (int k = 0; k < 200000; ++k) key += ".a";
  // The thousandth dot stands in column 2000.
  for (const std::string& text : {key + " = 1", "[" + key + "]", "x = {" + key + " = 1}"})
    EXPECT_THAT(
        reading_faults("# comment\n" + text),
        ElementsAre(AllOf(StartsWith("s.toml:2:20"), HasSubstr("malformed TOML (a key of more than"))));
  EXPECT_THAT(reading_faults(sample(), {key + "=1"}),
              ElementsAre(HasSubstr(": error: malformed key (a key of more than 1000 parts)")));
  // Dots of numbers, as a hull has them.
  std::string points = "hull = { points = [";
  for (int k = 0; k < 2000; ++k) points += "[0.5, 1.5, 0.25],";
  EXPECT_THAT(reading_faults(sample_with(16, points + "] }")), IsEmpty());
}

TEST(SceneReader, EmptySceneMissesWhatEverySceneNeeds) {
  EXPECT_THAT(reading_faults(""),
              ElementsAre("s.toml:1:1: error: missing key (end_time), analysis needs it",
                          "s.toml:1:1: error: missing key (time_step), analysis needs it",
                          "s.toml:1:1: error: no block (0), at least one [[block]] is needed"));
}

TEST(SceneReader, StaticAnalysisOfConstantLoadsNeedsNoTimes) {
  Diagnostics diagnostics;
  const auto times = [&](const std::string& lines) {
    const Scene scene = parse_scene(sample_with(2, "type = \"static\"\n" + lines), "s.toml",
                                    {"analysis.time_step=0.5"}, diagnostics);
    return std::pair(scene.analysis.end_time, scene.analysis.time_step);
  };
  EXPECT_EQ(times(""), std::pair(1.0, 0.5));
  EXPECT_EQ(times("end_time = 3"), std::pair(3.0, 0.5));
  const auto times_alone = [&](const std::string& lines) {
    std::string text = sample_with(2, "type = \"static\"\n" + lines);
    text.erase(text.find("time_step = 0.01"), 16);
    const Scene scene = parse_scene(text, "s.toml", {}, diagnostics);
    return std::pair(scene.analysis.end_time, scene.analysis.time_step);
  };
  EXPECT_EQ(times_alone(""), std::pair(1.0, 1e-3));
  EXPECT_EQ(times_alone("end_time = 1e-6"), std::pair(1e-6, 1e-6));
  EXPECT_THAT(printed(diagnostics), IsEmpty());
}

TEST(SceneReader, StaticAnalysisOfLoadsWithHistoriesNeedsTimes) {
  const std::string missing = "s.toml:1:2: error: missing key (end_time), analysis needs it";
  EXPECT_THAT(reading_faults(sample_with(2, ""), {"analysis.type=static", "block.B.load.0.history=[[0, 1]]"}),
              ElementsAre(missing));
  EXPECT_THAT(reading_faults(sample_with(2, ""),
                             {"analysis.type=static", "block.B.fix.0.displacement_history=[[0, 0, 0, 0]]"}),
              ElementsAre(missing));
}

TEST(SceneReader, SingleBracketsAreNoListOfTables) {
  EXPECT_THAT(
      reading_faults(sample_with(8, "[material]")),
      ElementsAre("s.toml:8:1: error: material has the wrong type (a table), a list of tables, each headed "
                  "[[material]], is needed"));
}

TEST(SceneReader, MissingFilesFoldersAndDevicesAreReported) {
  const std::filesystem::path folder = ::testing::TempDir();
  for (const std::filesystem::path& file :
       {folder / "no-such-scene.toml", folder, std::filesystem::path("/dev/zero")}) {
    Diagnostics diagnostics;
    (void)read_scene(file, {}, diagnostics);
    EXPECT_THAT(printed(diagnostics),
                ElementsAre(StartsWith(file.string() + ":1:1: error: scene file cannot be read (")));
  }
}

}  // namespace
}  // namespace ashlar::test::scene_reader_test

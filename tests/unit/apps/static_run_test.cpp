// `ashlar run` and `ashlar check` of static analyses.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>

#include "apps/program/run/run_command.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::static_run_test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class StaticRun : public RunCommand {};

constexpr const char* static_scene_text = R"(title = "static"
[analysis]
type = "static"
end_time = 1
time_step = 1e-2
[contact]
friction_angle = 31
[[material]]
name = "rock"
density = 2700
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "slope"
fixed = true
box = { min = [-6, -2, -1], max = [2, 2, 0] }
rotate = { axis = [0, -1, 0], angle = 30 }
[[block]]
name = "stone"
material = "rock"
box = { min = [-0.5, -0.5, 0], max = [0.5, 0.5, 1] }
rotate = { axis = [0, -1, 0], angle = 30 }
)";

TEST_F(StaticRun, APlateThatBendsRestsOnPointSprings) {
  // Springs at its four corners alone did not resist penetration of its centre, until that was too deep: it fell.
  write_text(scene_, R"(
[analysis]
type = "static"
[contact]
springs = "point"
normal_stiffness = 1e9
shear_stiffness = 5e8
friction_angle = 30
[[material]]
name = "m"
density = 2500
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "table"
fixed = true
box = { min = [-3, -3, -1], max = [3, 3, 0] }
[[block]]
name = "plate"
material = "m"
box = { min = [-1.5, -0.5, 0], max = [1.5, 0.5, 0.3] }
order = 4
[[measure]]
name = "middle"
block = "plate"
point = [0, 0, 0]
)");
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  EXPECT_EQ(nlohmann::json::parse(text("out/summary.json"))["status"], "equilibrium");
  // Three springs by three. The middle support of a beam over three stiff ones transmits 5/8 of its weight,
  // soft ones less: the middle spring no more than 25/64 of 22073 N.
  const double sinks = -column("out/history.csv", "middle.uz").back();
  EXPECT_GT(sinks, 0.0);
  EXPECT_LT(sinks, 25.0 / 64.0 * 22073.0 / 1e9);
}

TEST_F(StaticRun, EndsInEquilibrium) {
  write_text(scene_, static_scene_text);
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  EXPECT_EQ(nlohmann::json::parse(text("out/summary.json"))["status"], "equilibrium");
  ASSERT_EQ(run("out", {"--resume"}), exit_status::done) << faults_;
  EXPECT_EQ(nlohmann::json::parse(text("out/summary.json"))["status"], "equilibrium");
}

TEST_F(StaticRun, HoldsContactByMultipliersUnlessAStiffnessIsGiven) {
  write_text(scene_, static_scene_text);
  const auto augmented = [&](const std::string& more) {
    EXPECT_EQ(run("out", {"--force", "--set", more}), exit_status::done) << faults_;
    return nlohmann::json::parse(text("out/summary.json"))["scene"]["contact"]["augmented"].get<bool>();
  };
  EXPECT_TRUE(augmented("contact.friction_angle=31"));
  EXPECT_FALSE(augmented("contact.augmented=false"));
  EXPECT_FALSE(augmented("contact.normal_stiffness=1e9"));
  EXPECT_FALSE(augmented("contact.shear_stiffness=1e9"));
}

TEST_F(StaticRun, ComesBeforeMotion) {
  std::string scene = static_scene_text;
  scene.replace(scene.find("type = \"static\""), 15, "initial_state = \"static\"");
  scene.replace(scene.find("end_time = 1\n"), 12, "end_time = 0.2");
  scene += "[[measure]]\nname = \"top\"\nblock = \"stone\"\npoint = [-0.5, 0, 0.8660254]\n";
  write_text(scene_, scene);
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const std::vector<double> ways = column("out/history.csv", "top.uz");
  EXPECT_LT(ways.front(), -1e-7) << "pressed by its weight at the start";
  for (const double displacement : ways) EXPECT_NEAR(displacement, ways.front(), 1e-10);
  ASSERT_EQ(run("half", {"--set", "analysis.end_time=0.1"}), exit_status::done) << faults_;
  ASSERT_EQ(run("half", {"--resume"}), exit_status::done) << faults_;
  EXPECT_EQ(text("half/history.csv"), text("out/history.csv"));
  // Blocks that do not stand are reported, and move from their initial place.
  ASSERT_EQ(run("slides", {"--set", "contact.friction_angle=20"}), exit_status::done) << faults_;
  EXPECT_THAT(faults_, HasSubstr("all start as placed"));
  EXPECT_EQ(column("slides/history.csv", "top.uz").front(), 0.0);
  EXPECT_LT(column("slides/history.csv", "top.uz").back(), -0.01);
}

// A table under a stone that is tilted in very many levels, by less than friction holds.
std::string tilted_slowly() {
  std::string scene = static_scene_text;
  scene.replace(scene.find("end_time = 1\n"), 12, "end_time = 1000");
  scene.insert(scene.find("time_step"), "gravity_history = [[0, 0, 0, -9.81], [1000, 0.1, 0, -9.81]]\n");
  return scene;
}

TEST_F(StaticRun, InterruptedSavesItsStateAndGoesOn) {
  write_text(scene_, tilted_slowly());
  (void)std::signal(SIGINT, SIG_DFL);  // a shell's background job ignores it
  std::thread sender([&] {
    for (int k = 0; k < 60000 && lines("out/history.csv").size() < 20; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(::getpid(), SIGINT);
  });
  const int status = run("out");
  sender.join();
  ASSERT_EQ(status, exit_status::interrupted) << faults_;
  EXPECT_THAT(faults_, AllOf(HasSubstr("interrupted after step"), HasSubstr("with --resume goes on")));
  const auto summary = nlohmann::json::parse(text("out/summary.json"));
  EXPECT_EQ(summary["status"], "interrupted");
  // Some levels farther.
  const std::string end = fmt::format("analysis.end_time={}", summary["time"].get<double>() + 0.1);
  ASSERT_EQ(run("out", {"--resume", "--set", end}), exit_status::done) << faults_;
  ASSERT_EQ(run("straight", {"--set", end}), exit_status::done) << faults_;
  expect_same_results("straight", "out");
}

/// Text that raises a signal as soon as something is written.
class RaisingText : public std::stringbuf {
 public:
  explicit RaisingText(std::string word) : word_(std::move(word)) {}

 protected:
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    const std::streamsize written = std::stringbuf::xsputn(text, count);
    if (!word_.empty() && str().find(word_) != std::string::npos) {
      word_.clear();
      ::raise(SIGINT);
    }
    return written;
  }

 private:
  std::string word_;
};

TEST_F(StaticRun, InterruptedBeforeMotionStartsAnew) {
  std::string scene = static_scene_text;
  scene.replace(scene.find("type = \"static\""), 15, "initial_state = \"static\"");
  scene.replace(scene.find("end_time = 1\n"), 12, "end_time = 0.05");
  write_text(scene_, scene);
  // The estimate is the last that is said before the static analysis begins.
  RaisingText faults("estimate:");
  std::ostream err(&faults);
  std::ostringstream out;
  EXPECT_EQ(run_command_line({"run", scene_.string(), "--out", (folder_ / "out").string()}, out, err),
            exit_status::interrupted);
  EXPECT_THAT(faults.str(),
              HasSubstr("ashlar: interrupted in the static analysis before the motion "
                        "(initial_state = \"static\"): nothing of it is saved; run the same command "
                        "again\n"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "history.csv"));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  ASSERT_EQ(run("straight"), exit_status::done) << faults_;
  expect_same_results("straight", "out");
}

TEST_F(StaticRun, NeedsNoTimesWithConstantLoads) {
  std::string scene = static_scene_text;
  scene.erase(scene.find("end_time"), std::string("end_time = 1\ntime_step = 1e-2\n").size());
  write_text(scene_, scene);
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  EXPECT_EQ(nlohmann::json::parse(text("out/summary.json"))["status"], "equilibrium");
}

// Two cubes of equal mass on a slope whose tangent is 0.5, with a friction of 0.3: both go down by
// g (sin - 0.3 cos) = 9.81 (0.5 - 0.3) / sqrt(1.25) m/s^2. The component along y is a rounding error.
TEST_F(StaticRun, CountsWhatMoves) {
  write_text(scene_, R"(analysis = { type = "static" }
contact = { friction_angle = "= atan(0.3) / deg" }
material = [{ name = "stone", density = 2000, young_modulus = 1e10, poisson_ratio = 0.2 }]
[[block]]
name = "slope"
fixed = true
box = { min = [-9, -4, -1], max = [9, 4, 0] }
rotate = { axis = [0, -1, 0], angle = "= atan(0.5) / deg" }
[[block]]
name = "stone"
material = "stone"
box = { min = [-4, -1, 0], max = [-3, 0, 1] }
rotate = { axis = [0, -1, 0], angle = "= atan(0.5) / deg" }
array = { count = [2], step = [[4, 0, 2]] }
)");
  ASSERT_EQ(command({"run", scene_.string(), "--out", (folder_ / "out").string()}), exit_status::done)
      << faults_;
  EXPECT_THAT(faults_, HasSubstr("no equilibrium: 2 of 2 blocks move: stone.1, stone.2; block stone."));
  EXPECT_THAT(faults_,
              ContainsRegex("fastest, acceleration \\[-1\\.5[67][0-9]*, 0, -0\\.78[0-9]*\\] m/s\\^2"));
}

TEST_F(StaticRun, NamesWhatMoves) {
  write_text(scene_, static_scene_text);
  ASSERT_EQ(command({"run", scene_.string(), "--out", (folder_ / "out").string(), "--set",
                     "contact.friction_angle=20"}),
            exit_status::done)
      << faults_;
  EXPECT_THAT(faults_, HasSubstr("no equilibrium: block stone moves, acceleration [-1.5"));
  const auto summary = nlohmann::json::parse(text("out/summary.json"));
  EXPECT_EQ(summary["status"], "moving");
  ASSERT_EQ(summary["moving"].size(), 1U);
  EXPECT_EQ(summary["moving"][0]["block"], "stone");
  // g (sin 30 - cos 30 tan 20) cos 30 down the slope, towards -x
  EXPECT_NEAR(summary["moving"][0]["acceleration"][0], -1.56994, 2e-3);
}

TEST_F(StaticRun, TellsWhatCameToRestFarAway) {
  // A plank on its edge, leaning out by more than it is thick, falls flat: its middle goes 0.33 m down and
  // 0.42 m to the side, and it turns.
  write_text(scene_, R"([analysis]
type = "static"
[contact]
friction_angle = 45
[[material]]
name = "m"
density = 2500
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "floor"
fixed = true
box = { min = [-3, -3, -1], max = [3, 3, 0] }
[[block]]
name = "plank"
material = "m"
box = { min = [-0.4, -0.5, 0], max = [0, 0.5, 1] }
rotate = { axis = [0, 1, 0], angle = 30 }
)");
  ASSERT_EQ(command({"run", scene_.string(), "--out", (folder_ / "out").string()}), exit_status::done)
      << faults_;
  EXPECT_THAT(faults_, HasSubstr("equilibrium, but far from where they were placed: block plank by 0."));
  const auto summary = nlohmann::json::parse(text("out/summary.json"));
  EXPECT_EQ(summary["status"], "equilibrium");
  ASSERT_EQ(summary["displaced"].size(), 1U);
  EXPECT_EQ(summary["displaced"][0]["block"], "plank");
  EXPECT_GT(summary["displaced"][0]["distance"], 0.5);
  EXPECT_LT(summary["displaced"][0]["distance"], 1.0);
}

TEST_F(StaticRun, FailsWhereItDoesNotConvergeAndKeepsItsLastState) {
  write_text(scene_, static_scene_text);
  // Springs that make the numbers of the system overflow.
  EXPECT_EQ(run("out", {"--set", "contact.normal_stiffness=1e300"}), exit_status::failed);
  EXPECT_THAT(faults_,
              AllOf(StartsWith("ashlar: error: no equilibrium was found in 0 iterations under the loads at "
                               "t = 1 s: the first iteration was tried 61 times; "),
                    HasSubstr("another normal_stiffness may converge"),
                    HasSubstr("the last state is in " + (folder_ / "out").string())));
  EXPECT_EQ(nlohmann::json::parse(text("out/summary.json"))["status"], "not converged");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/checkpoint"));
}

TEST_F(StaticRun, RefusesABlockThatNothingHolds) {
  write_text(scene_, static_scene_text);
  EXPECT_EQ(run("out", {"--set", "block.stone.translate=[0,0,0.5]"}), exit_status::bad_input);
  EXPECT_THAT(faults_, AllOf(HasSubstr("block stone has no contact"), HasSubstr("any rigid motion")));
}

TEST_F(StaticRun, RefusesADistanceThatCoordinatesCannotTell) {
  write_text(scene_, static_scene_text);
  EXPECT_EQ(run("out", {"--set", "contact.distance=1e-30"}), exit_status::bad_input);
  EXPECT_THAT(faults_, AllOf(HasSubstr("distance is less than coordinates are rounded to (1e-30 m)"),
                             HasSubstr("is needed"), Not(HasSubstr("has no contact"))));
}

TEST_F(StaticRun, SaysThatALaterJointUntiesBlocks) {
  const std::string ties = R"(
[[joint]]
blocks = ["stone", "slope"]
tied = true
)";
  write_text(scene_, static_scene_text + ties + "[[joint]]\nblocks = [\"*\", \"stone\"]\ntied = false\n");
  EXPECT_EQ(run("out"), exit_status::done);
  EXPECT_THAT(faults_,
              HasSubstr("warning: tied has no effect: a later [[joint]] of the same blocks unties them"));
}

TEST_F(StaticRun, CheckNamesWhatAStaticAnalysisCannotHold) {
  // Two points on the x axis: the beam may turn about it.
  write_text(scene_, R"([analysis]
type = "static"
end_time = 1
time_step = 1
[[material]]
name = "rock"
density = 2700
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "beam"
material = "rock"
box = { min = [0, 0, 0], max = [4, 1, 1] }
[[block.fix]]
point = [0, 0, 0]
[[block.fix]]
point = [4, 0, 0]
)");
  EXPECT_EQ(command({"check", scene_.string()}), exit_status::bad_input);
  EXPECT_THAT(faults_, AllOf(HasSubstr(":10:1: error: block beam has no contact"),
                             HasSubstr("rotation about [1, 0, 0] through [2, 0, 0]")));
}

// A beam with a load at its end: order 2 has 3/4 of the energy, an error of 1/2, and of the deflection; order 3 bends as
// it should.
TEST_F(StaticRun, OrdersThatAreTooLowAreTold) {
  write_text(scene_, R"(analysis = { type = "static", gravity = [0, 0, 0] }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
[[block]]
name = "beam"
material = "stone"
order = 2
box = { min = [0, 0, 0], max = [10, 1, 1] }
fix = [{ plane = { point = [0, 0, 0], normal = [1, 0, 0] } }]
load = [{ plane = { point = [10, 0, 0], normal = [1, 0, 0] }, force = [0, 0, -1] }]
[[measure]]
name = "tip"
block = "beam"
point = [10, 0.5, 0.5]
)");
  ASSERT_EQ(command({"run", scene_.string(), "--out", (folder_ / "two").string()}), exit_status::done);
  EXPECT_THAT(faults_, HasSubstr("warning: the estimated error of deformation is 50 %"));
  EXPECT_THAT(faults_,
              HasSubstr("warning: the estimated error of measure tip by the orders of blocks is 25 %"));
  EXPECT_THAT(faults_, HasSubstr("block beam of order 2"));
  ASSERT_EQ(
      command({"run", scene_.string(), "--out", (folder_ / "three").string(), "--set", "block.0.order=3"}),
      exit_status::done);
  EXPECT_THAT(faults_, Not(HasSubstr("estimated error")));
}

// A column on a pad that gives way under it, which lies on a fixed floor: it sinks by more than blocks may go, but no
// contact lets it fall.
TEST_F(StaticRun, BlockThatSinksOntoAFixedFloorIsNotMoving) {
  write_text(scene_, R"(analysis = { type = "static" }
contact = { friction_angle = 30 }
material = [{ name = "pad", density = 1200, young_modulus = 5e4, poisson_ratio = 0.3 },
            { name = "stone", density = 2500, young_modulus = 3e10, poisson_ratio = 0.2 }]
block = [
  { name = "floor", fixed = true, box = { min = [-5, -5, -2], max = [5, 5, 0] } },
  { name = "pad", material = "pad", order = 1, box = { min = [0, 0, 0], max = [2, 2, 0.5] } },
  { name = "column", material = "stone", box = { min = [0, 0, 0.5], max = [2, 2, 4.5] } },
]
)");
  EXPECT_EQ(run("sinks"), exit_status::failed);
  EXPECT_EQ(nlohmann::json::parse(text("sinks/summary.json"))["status"], "not converged");
}

}  // namespace
}  // namespace ashlar::static_run_test

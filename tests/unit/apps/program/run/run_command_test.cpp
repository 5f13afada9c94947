// `ashlar run` from its command line to its files.
#include "apps/program/run/run_command.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::run_command_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

TEST_F(RunCommand, WritesTheResultFolder) {
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  EXPECT_THAT(files("out"),
              ElementsAre(".ashlar", "blocks.pvd", "checkpoint", "contacts.csv", "contacts.pvd", "frames",
                          "history.csv", "history.units.json", "joints.pvd", "loads.pvd", "summary.json"));
  EXPECT_THAT(
      files("out/frames"),
      ElementsAre("blocks_0000000.vtu", "blocks_0000010.vtu", "blocks_0000020.vtu", "blocks_0000030.vtu",
                  "blocks_0000040.vtu", "contacts_0000000.vtu", "contacts_0000010.vtu",
                  "contacts_0000020.vtu", "contacts_0000030.vtu", "contacts_0000040.vtu",
                  "joints_0000000.vtu", "joints_0000010.vtu", "joints_0000020.vtu", "joints_0000030.vtu",
                  "joints_0000040.vtu", "loads_0000000.vtu", "loads_0000010.vtu", "loads_0000020.vtu",
                  "loads_0000030.vtu", "loads_0000040.vtu"));
}

TEST_F(RunCommand, HistoryHasARowPerStepAndTheColumnsOfRecord) {
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const std::vector<std::string> rows = lines("out/history.csv");
  ASSERT_EQ(rows.size(), 42U);  // columns, the start and 40 steps
  EXPECT_EQ(rows[0],
            "step,time,dt,tip.x,tip.y,tip.z,tip.ux,tip.uy,tip.uz,tip.vx,tip.vy,tip.vz,energy.kinetic,"
            "energy.elastic,energy.gravity,energy.contact,energy.friction,energy.damping,energy.applied,"
            "energy.numerical,"
            "energy.residual,momentum.x,momentum.y,momentum.z,angular_momentum.x,angular_momentum.y,"
            "angular_momentum.z,contacts.open,contacts.locked,contacts.sliding,penetration.max,"
            "open_close.iterations,energy.redetection_gained,energy.redetection_lost,tip.sxx,tip.syy,tip.szz,"
            "tip.sxy,"
            "tip.syz,tip.sxz,tip.speed");
  EXPECT_THAT(rows[1], StartsWith("0,0,0,4,0,0,0,0,0,0,0,0,"));
  EXPECT_THAT(rows[41], StartsWith("40,0.04"));
}

TEST_F(RunCommand, HistoryEndsWithTheStressOfMeasuredPoints) {
  // A bar clamped at x = 0 without lateral contraction, pulled by 1000 Pa: stress is that everywhere.
  std::string bar = scene_text;
  bar.replace(bar.find("poisson_ratio = 0.2"), 19, "poisson_ratio = 0.0");
  bar.insert(bar.find("[[measure]]"),
             "[[block.load]]\nplane = { point = [4, 0, 0], normal = [1, 0, 0] }\ntraction = [1000, 0, 0]\n");
  write_text(scene_, bar);
  for (const char* formulation : {"total", "incremental"}) {
    ASSERT_EQ(
        run(formulation, {"--set", "analysis.initial_state=equilibrium", "--set", "analysis.gravity=[0,0,0]",
                          "--set", std::string("analysis.formulation=") + formulation}),
        exit_status::done)
        << faults_;
    std::istringstream row(lines(std::string(formulation) + "/history.csv").at(1));
    std::vector<double> values;
    for (std::string value; std::getline(row, value, ',');) values.push_back(std::stod(value));
    ASSERT_EQ(values.size(), 41U);
    EXPECT_NEAR(values[34], 1000.0, 1e-5);
    for (std::size_t k = 35; k < 40; ++k) EXPECT_NEAR(values[k], 0.0, 1e-5);
  }
}

TEST_F(RunCommand, ContactsOfEveryFrameAreInTheTable) {
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const std::vector<std::string> rows = lines("out/contacts.csv");
  ASSERT_GT(rows.size(), 1U);
  EXPECT_THAT(rows[1], StartsWith("10,"));
  EXPECT_EQ(rows[0],
            "step,time,block_a,block_b,points.face_face,points.vertex_face,points.edge_edge,area,"
            "normal_force.x,normal_force.y,normal_force.z,shear_force.x,shear_force.y,shear_force.z,work");
  for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_THAT(rows[k], HasSubstr(",A,B,"));
}

TEST_F(RunCommand, ContactForcesAreWhatChangesMomentum) {
  // m dv/dt = m g + F of the cube in every step, also of points that have opened at its end.
  for (const char* integrator : {"dda", "average-acceleration", "generalized-alpha"}) {
    ASSERT_EQ(run("out", {"--force", "--set", "analysis.integrator=" + std::string(integrator), "--set",
                          "output.every=1", "--set", "measure.tip.block=A", "--set",
                          "measure.tip.point=[3.25, 0, 0.75]"}),
              exit_status::done)
        << faults_;
    std::map<double, double> forces;  // by step
    const std::vector<double> steps = column("out/contacts.csv", "step");
    for (const char* part : {"normal_force.z", "shear_force.z"}) {
      const std::vector<double> values = column("out/contacts.csv", part);
      for (std::size_t k = 0; k < steps.size(); ++k) forces[steps[k]] += values[k];
    }
    const std::vector<double> step = column("out/history.csv", "step");
    const std::vector<double> length = column("out/history.csv", "dt");
    const std::vector<double> velocity = column("out/history.csv", "tip.vz");
    double most = 0.0;
    for (std::size_t k = 1; k < step.size(); ++k) {
      const double force = 450.0 * ((velocity[k] - velocity[k - 1]) / length[k] + 9.81);
      EXPECT_NEAR(forces[step[k]], force, 1e-2) << integrator << " " << step[k];
      most = std::max(most, force);
    }
    EXPECT_GT(most, 2e4) << integrator;
  }
}

TEST_F(RunCommand, EveryColumnIsInTheReferenceOfResults) {
  write_text(scene_, std::string(scene_text).replace(std::string(scene_text).find("\"tip\""), 5, "\"NAME\""));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const std::string reference = read_text(ASHLAR_DATA_DIR "/../apps/docs/reference/results.md");
  for (const char* table : {"out/history.csv", "out/contacts.csv"}) {
    std::istringstream columns(lines(table).at(0));
    for (std::string column; std::getline(columns, column, ',');)
      EXPECT_THAT(reference, HasSubstr("`" + column + "`")) << table;
  }
}

TEST_F(RunCommand, SummaryTellsWhatWasDone) {
  ASSERT_EQ(run("out", {"--set", "contact.friction_angle=20"}), exit_status::done) << faults_;
  const auto summary = nlohmann::json::parse(text("out/summary.json"));
  for (const char* key :
       {"status", "steps", "rejected_steps", "unknowns", "wall_seconds", "peak_memory_bytes",
        "penetration_max", "energy_residual", "counts", "versions", "scene"}) {
    EXPECT_TRUE(summary.contains(key)) << key;
  }
  EXPECT_EQ(summary["status"], "completed");
  EXPECT_EQ(summary["steps"], 40);
  EXPECT_EQ(summary["frames"], 5);
  EXPECT_EQ(summary["unknowns"], 12 + 12);  // A: 3 x 4; B: 3 x (10 - 6), six do not vanish at the clamp
  EXPECT_GT(summary["penetration_max"], 0.0);
  EXPECT_EQ(summary["scene"]["contact"]["friction_angle"], 20.0);
}

TEST_F(RunCommand, QuietSaysNothingOthersSayWhatWasChosen) {
  ASSERT_EQ(run("quiet"), exit_status::done);
  EXPECT_THAT(faults_, IsEmpty());
  EXPECT_THAT(printed_, IsEmpty());
  ASSERT_EQ(command({"run", scene_.string(), "--out", (folder_ / "out").string()}), exit_status::done);
  EXPECT_THAT(faults_, AllOf(HasSubstr("chosen: contact.distance = "), HasSubstr("step 40 ")));
  EXPECT_THAT(printed_, IsEmpty());
}

TEST_F(RunCommand, WarningsAreSaidEvenQuietlyAndNamesOfBlocksThatDoNotSettle) {
  EXPECT_EQ(command({"run", scene_.string(), "--out", (folder_ / "out").string(), "--set",
                     "analysis.initial_state=equilibrium"}),
            exit_status::done);
  EXPECT_THAT(faults_,
              HasSubstr("\nnot settled: A (initial_state settles blocks that their own supports hold)\n"));
  EXPECT_THAT(faults_, Not(HasSubstr("warning")));
  // 3600 kg/m^3 x 9.81 m/s^2 x 1 m of B is 0.35 of 1e5 Pa.
  EXPECT_EQ(run("soft", {"--set", "material.rock.young_modulus=1e5", "--set", "analysis.end_time=0.001"}),
            exit_status::done);
  EXPECT_THAT(faults_, StartsWith("--set material.rock.young_modulus=1e5: warning: young_modulus is small"));
  EXPECT_EQ(command({"check", scene_.string(), "--set", "material.rock.young_modulus=1e5"}),
            exit_status::done);
  EXPECT_THAT(faults_, HasSubstr("warning: young_modulus is small"));
  EXPECT_THAT(printed_, HasSubstr("s.toml: good: 2 blocks"));
}

TEST_F(RunCommand, FramesByTimeStandAtTheNearestSteps) {
  std::string by_time = scene_text;
  by_time.replace(by_time.find("every = 10"), 10, "interval = 0.0094");
  write_text(scene_, by_time);
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const std::vector<std::string> frames = files("out/frames");
  // 0.0094, 0.0188, 0.0282 and 0.0376 s, and the end.
  EXPECT_THAT(std::vector<std::string>(frames.begin(), frames.begin() + 6),
              ElementsAre("blocks_0000000.vtu", "blocks_0000009.vtu", "blocks_0000019.vtu",
                          "blocks_0000028.vtu", "blocks_0000038.vtu", "blocks_0000040.vtu"));
}

TEST_F(RunCommand, BadInputLeavesNothingBehind) {
  EXPECT_EQ(run("out", {"--set", "analysis.time_step=-1"}), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("--set analysis.time_step=-1: error: "));
  EXPECT_EQ(run("new/out", {"--set", "block.A.box.min=[3.0, -0.25, 0.25]"}), exit_status::bad_input);
  EXPECT_THAT(faults_, AllOf(StartsWith(scene_.string() + ":19:1: error: "), HasSubstr("overlap by 0.25 m")));
  EXPECT_EQ(command({"run", (folder_ / "none.toml").string(), "--out", (folder_ / "out").string()}),
            exit_status::bad_input);
  EXPECT_EQ(run("out", {"--no-such-option"}), exit_status::bad_input);
  EXPECT_EQ(folder_.entry_count(), 1U) << "only the scene";
}

TEST_F(RunCommand, ResultsThatCannotBeWrittenEndTheRunWithTheReason) {
  write_text(folder_ / "file", "in the way");
  EXPECT_EQ(run("file/out"), exit_status::bad_input);
  EXPECT_THAT(faults_, AllOf(StartsWith("ashlar: error: cannot create the result folder "),
                             HasSubstr((folder_ / "file/out").string()), HasSubstr("Not a directory")));
}

TEST_F(RunCommand, FailedRunSavesItsLastState) {
  // Springs that stiff swallow the inertia of the blocks, or make the numbers of the system overflow.
  for (const char* stiffness : {"1e40", "1e300"}) {
    EXPECT_EQ(run("out", {"--force", "--set", "contact.normal_stiffness=" + std::string(stiffness)}),
              exit_status::failed);
    EXPECT_THAT(faults_, AllOf(StartsWith("ashlar: error: step "), HasSubstr("was rejected"),
                               HasSubstr((folder_ / "out").string())));
    const auto summary = nlohmann::json::parse(text("out/summary.json"));
    EXPECT_EQ(summary["status"], "failed");
    EXPECT_GT(summary["rejected_steps"]["count"], 0);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/checkpoint"));
  }
}

TEST_F(RunCommand, StepThatCannotBeTakenFailsTheRun) {
  // A needle so thin that its long edges are one as soon as it moves.
  EXPECT_EQ(run("out", {"--set", "block.A.box={min=[0, 0, 0.5], max=[1e-45, 1e-45, 0.5000001]}", "--set",
                        "contact.normal_stiffness=auto", "--set", "block.A.velocity=[0, 0, 0]", "--set",
                        "block.B.order=1"}),
            exit_status::failed);
  EXPECT_THAT(faults_, AllOf(StartsWith("ashlar: error: step 1 at t = 0 s "),
                             HasSubstr("the last accepted state is in " + (folder_ / "out").string())));
  EXPECT_EQ(nlohmann::json::parse(text("out/summary.json"))["status"], "failed");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/checkpoint"));
}

TEST_F(RunCommand, ResumedIncrementalRunIsTheRunThatNeverStopped) {
  const std::vector<std::string> incremental = {"--set", "analysis.formulation=incremental"};
  ASSERT_EQ(run("straight", incremental), exit_status::done) << faults_;
  ASSERT_EQ(run("cut", {"--set", "analysis.formulation=incremental", "--set", "analysis.end_time=0.025"}),
            exit_status::done)
      << faults_;
  ASSERT_EQ(run("cut", {"--resume", "--set", "analysis.formulation=incremental"}), exit_status::done)
      << faults_;
  expect_same_results("straight", "cut");
}

TEST_F(RunCommand, ResumedRunIsTheRunThatNeverStopped) {
  ASSERT_EQ(run("straight"), exit_status::done) << faults_;
  // In the middle of contact and between two frames.
  ASSERT_EQ(run("cut", {"--set", "analysis.end_time=0.017"}), exit_status::done) << faults_;
  EXPECT_EQ(files("cut/frames").size(), 12U) << "frames at 0, 10 and the end";
  ASSERT_EQ(run("cut", {"--resume", "--threads", "2"}), exit_status::done) << faults_;
  expect_same_results("straight", "cut");
  const auto straight = nlohmann::json::parse(text("straight/summary.json"));
  const auto cut = nlohmann::json::parse(text("cut/summary.json"));
  for (const char* key : {"steps", "time", "frames", "penetration_max", "energy_residual", "energy_max"}) {
    EXPECT_EQ(straight[key], cut[key]) << key;
  }
  // Nothing is left to do.
  ASSERT_EQ(run("cut", {"--resume"}), exit_status::done) << faults_;
  expect_same_results("straight", "cut");
}

TEST_F(RunCommand, ResumeDropsWhatAKilledRunWroteAfterItsCheckpoint) {
  ASSERT_EQ(run("straight"), exit_status::done) << faults_;
  ASSERT_EQ(run("cut", {"--set", "analysis.end_time=0.02"}), exit_status::done) << faults_;
  const std::string checkpoint = text("cut/checkpoint");
  ASSERT_EQ(run("cut", {"--resume", "--set", "analysis.end_time=0.035"}), exit_status::done) << faults_;
  write_text(folder_ / "cut/checkpoint", checkpoint);
  std::ofstream(folder_ / "cut/history.csv", std::ios::app) << "36,0.03";
  ASSERT_EQ(run("cut", {"--resume"}), exit_status::done) << faults_;
  expect_same_results("straight", "cut");
}

TEST_F(RunCommand, ResumeDoesNotGoBackInTime) {
  ASSERT_EQ(run("out", {"--set", "analysis.end_time=0.02"}), exit_status::done) << faults_;
  const std::string summary = text("out/summary.json");
  EXPECT_EQ(run("out", {"--resume", "--set", "analysis.end_time=0.01"}), exit_status::bad_input);
  EXPECT_THAT(faults_,
              HasSubstr("end_time (0.01 s) is before the time that the run has reached (0.02 s), a later"));
  EXPECT_EQ(text("out/summary.json"), summary);
  EXPECT_EQ(run("out", {"--resume", "--set", "analysis.end_time=0.02"}), exit_status::done) << faults_;
}

TEST_F(RunCommand, ResumeNeedsTheCheckpointOfTheSameScene) {
  EXPECT_EQ(run("out", {"--resume"}), exit_status::bad_input);
  EXPECT_THAT(faults_, AllOf(StartsWith((folder_ / "out/checkpoint").string() + ": error: no checkpoint")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));

  ASSERT_EQ(run("out", {"--set", "analysis.end_time=0.005"}), exit_status::done) << faults_;
  const std::string history = text("out/history.csv");
  EXPECT_EQ(run("out", {"--resume", "--set", "material.rock.density=3601"}), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("checkpoint: error: checkpoint of another scene"));
  std::string checkpoint = text("out/checkpoint");
  checkpoint[checkpoint.size() / 2] ^= 1;
  write_text(folder_ / "out/checkpoint", checkpoint);
  EXPECT_EQ(run("out", {"--resume"}), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("checkpoint: error: checkpoint is damaged"));
  write_text(folder_ / "out/checkpoint", checkpoint.substr(0, 20));
  EXPECT_EQ(run("out", {"--resume"}), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("checkpoint: error: checkpoint is damaged"));
  EXPECT_EQ(text("out/history.csv"), history);
}

TEST_F(RunCommand, ResumeNeedsTheTablesOfTheCheckpoint) {
  ASSERT_EQ(run("out", {"--set", "analysis.end_time=0.005"}), exit_status::done) << faults_;
  const std::string history = text("out/history.csv");
  write_text(folder_ / "out/history.csv", history.substr(0, history.rfind("\n4,") + 1));
  EXPECT_EQ(run("out", {"--resume"}), exit_status::bad_input);
  EXPECT_THAT(faults_, AllOf(StartsWith("ashlar: error: cannot resume "),
                             HasSubstr("history.csv: its rows end at step 3, before step 5")));
  write_text(folder_ / "out/history.csv", history);
  EXPECT_EQ(run("out", {"--resume"}), exit_status::done) << faults_;
}

TEST_F(RunCommand, NewRunRemovesTheResultsOfAnEarlierOne) {
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  ASSERT_EQ(run("out", {"--force", "--set", "analysis.end_time=0.01"}), exit_status::done) << faults_;
  EXPECT_THAT(
      files("out/frames"),
      ElementsAre("blocks_0000000.vtu", "blocks_0000010.vtu", "contacts_0000000.vtu", "contacts_0000010.vtu",
                  "joints_0000000.vtu", "joints_0000010.vtu", "loads_0000000.vtu", "loads_0000010.vtu"));
  EXPECT_EQ(lines("out/history.csv").size(), 12U);
}

TEST_F(RunCommand, InterruptedRunSavesItsStateAndGoesOn) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1}) {
    const std::string name = "out" + std::to_string(signal);
    (void)std::signal(signal, SIG_DFL);  // a shell's background job ignores SIGINT
    // Sent as soon as some steps are written, whenever that is.
    std::thread sender([&] {
      for (int k = 0; k < 60000 && lines(name + "/history.csv").size() < 5; ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ::kill(::getpid(), signal);
    });
    const int status = run(name, {"--set", "analysis.end_time=1000"});
    sender.join();
    ASSERT_EQ(status, exit_status::interrupted) << faults_;
    const auto summary = nlohmann::json::parse(text(name + "/summary.json"));
    EXPECT_EQ(summary["status"], "interrupted");
    const int steps = summary["steps"];
    EXPECT_EQ(faults_,
              fmt::format("ashlar: interrupted after step {} at t = {:.9g} s of 1000 s; the state is saved "
                          "in {}, the same command with --resume goes on\n",
                          steps, summary["time"].get<double>(), (folder_ / name).string()));
    const std::string end = "analysis.end_time=" + std::to_string(0.001 * (steps + 10));
    ASSERT_EQ(run(name, {"--resume", "--set", end}), exit_status::done) << faults_;
    ASSERT_EQ(run("straight", {"--force", "--set", end}), exit_status::done) << faults_;
    expect_same_results("straight", name);
  }
}
TEST_F(RunCommand, OrderThatAShapeDoesNotBearIsRefusedWithTheHighestThatItDoes) {
  write_text(folder_ / "ell.off", R"(OFF
12 8 0
0 0 0
1 0 0
1 0.001 0
0.001 0.001 0
0.001 1 0
0 1 0
0 0 0.001
1 0 0.001
1 0.001 0.001
0.001 0.001 0.001
0.001 1 0.001
0 1 0.001
6 5 4 3 2 1 0
6 6 7 8 9 10 11
4 0 1 7 6
4 1 2 8 7
4 2 3 9 8
4 3 4 10 9
4 4 5 11 10
4 5 0 6 11
)");
  const auto with_order = [&](int order) {
    std::string scene = scene_text;
    scene.replace(scene.find("order = 2"), 9, "order = " + std::to_string(order));
    const std::size_t box = scene.find("box = { min = [0, -0.5");
    scene.replace(box, scene.find('\n', box) - box, "mesh = { file = \"ell.off\" }");
    scene.erase(scene.find("[[block.fix]]"));
    write_text(scene_, scene);
    return command({"check", scene_.string()});
  };
  ASSERT_EQ(with_order(10), exit_status::bad_input);
  const std::string place =
      ":22:9: error: order is too high for the shape of block B in double precision (10), at most ";
  const std::size_t found = faults_.find(place);
  ASSERT_NE(found, std::string::npos) << faults_;
  const int highest = std::stoi(faults_.substr(found + place.size()));
  EXPECT_EQ(with_order(highest), exit_status::done) << faults_;
  EXPECT_EQ(with_order(highest + 1), exit_status::bad_input);
}

}  // namespace
}  // namespace ashlar::run_command_test

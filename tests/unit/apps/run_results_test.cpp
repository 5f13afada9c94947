// Results in case of errors: other runs, foreign files, full disks, manual changes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::run_results_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class RunResults : public RunCommand {
 protected:
  /// Waits until a run has written some rows. @return false if it takes forever
  [[nodiscard]] bool wait_for_rows(const std::string& out) const {
    for (int k = 0; k < 60000; ++k) {
      if (lines(out + "/history.csv").size() > 5) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

  /// Runs while something else is done as soon as some rows are written. @return exit status
  int run_during(const std::string& out, const std::function<void()>& act) {
    std::thread other([&] {
      EXPECT_TRUE(wait_for_rows(out));
      act();
    });
    const int status = run(out, {"--set", "analysis.end_time=1000"});
    other.join();
    return status;
  }

  [[nodiscard]] nlohmann::json summary(const std::string& out) const {
    return nlohmann::json::parse(text(out + "/summary.json"));
  }
};

/// Files of this process cannot become larger while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &old_);
    rlimit limited = old_;
    limited.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &old_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_{};
};

TEST_F(RunResults, ASecondRunIntoTheFolderIsRefusedAndDisturbsNothing) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) ::_exit(run("out", {"--set", "analysis.end_time=1000"}));
  ASSERT_TRUE(wait_for_rows("out"));
  for (const char* how : {"--quiet", "--force", "--resume"}) {
    EXPECT_EQ(run("out", {"--set", "analysis.end_time=1000", how}), exit_status::bad_input) << how;
    EXPECT_THAT(faults_, StartsWith("ashlar: error: result folder " + (folder_ / "out").string() +
                                    " is in use by process " + std::to_string(child)));
  }
  ::kill(child, SIGTERM);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), exit_status::interrupted);
  // Every step has its row, none twice.
  const std::vector<double> steps = column("out/history.csv", "step");
  for (std::size_t k = 0; k < steps.size(); ++k) ASSERT_EQ(steps[k], static_cast<double>(k));
}

TEST_F(RunResults, FoldersOfOthersAreLeftAlone) {
  std::filesystem::create_directories(folder_ / "theirs/frames");
  for (const char* name : {"theirs/frames/blocks_0000000.vtu", "theirs/history.csv", "theirs/summary.json"})
    write_text(folder_ / name, "theirs");
  for (const char* how : {"--quiet", "--force"}) {
    EXPECT_EQ(run("theirs", {how}), exit_status::bad_input);
    EXPECT_EQ(faults_, "ashlar: error: folder " + (folder_ / "theirs").string() +
                           " is not empty and was not made by ashlar: choose another by --out\n");
  }
  EXPECT_THAT(files("theirs"), ElementsAre("frames", "history.csv", "summary.json"));
  EXPECT_EQ(text("theirs/frames/blocks_0000000.vtu"), "theirs");
  EXPECT_EQ(command({"run", scene_.string(), "--out", ""}), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("a name is needed"));
}

TEST_F(RunResults, ResultsAreReplacedOnlyByForceAndWhatElseIsThereStays) {
  ASSERT_EQ(run("out", {"--set", "analysis.end_time=0.02"}), exit_status::done) << faults_;
  const std::string history = text("out/history.csv"), checkpoint = text("out/checkpoint");
  EXPECT_EQ(run("out"), exit_status::bad_input);
  EXPECT_THAT(faults_, AllOf(HasSubstr("holds the results of a run"), HasSubstr("--force")));
  std::filesystem::remove(folder_ / "out/summary.json");
  EXPECT_EQ(run("out"), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("holds the checkpoint of a run that did not end"));
  EXPECT_EQ(text("out/history.csv"), history);
  EXPECT_EQ(text("out/checkpoint"), checkpoint);
  for (const char* name :
       {"out/notes.txt", "out/frames/mine.vtu", "out/frames/blocks_1.vtu", "out/view.html"})
    write_text(folder_ / name, "mine");
  std::filesystem::create_hard_link(folder_ / "out/history.csv", folder_ / "kept.csv");
  ASSERT_EQ(run("out", {"--force", "--set", "analysis.end_time=0.01"}), exit_status::done) << faults_;
  EXPECT_EQ(lines("out/history.csv").size(), 12U);
  EXPECT_EQ(text("kept.csv"), history);
  for (const char* name : {"out/notes.txt", "out/frames/mine.vtu", "out/frames/blocks_1.vtu"})
    EXPECT_EQ(text(name), "mine") << name;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/view.html")) << "that of other results";
}

TEST_F(RunResults, AForcedRunThatCannotStartKeepsWhatIsThere) {
  ASSERT_EQ(run("out", {"--set", "analysis.end_time=0.02"}), exit_status::done) << faults_;
  const std::string history = text("out/history.csv");
  EXPECT_EQ(run("out", {"--force", "--set", "analysis.time_step=-1"}), exit_status::bad_input);
  std::filesystem::remove(folder_ / "out/contacts.csv");
  std::filesystem::create_symlink(folder_ / "out/history.csv", folder_ / "out/contacts.csv");
  EXPECT_EQ(run("out", {"--force"}), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("contacts.csv is in the way"));
  EXPECT_EQ(text("out/history.csv"), history);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/checkpoint"));
}

TEST_F(RunResults, ACopyOfResultsIsToldFromStrangeFolders) {
  ASSERT_EQ(run("out", {"--set", "analysis.end_time=0.02"}), exit_status::done) << faults_;
  ASSERT_EQ(run("straight"), exit_status::done) << faults_;
  std::filesystem::remove(folder_ / "out/.ashlar");
  EXPECT_EQ(run("out"), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("holds results of an earlier version of ashlar, or a copy: --force"));
  EXPECT_EQ(run("out", {"--resume"}), exit_status::done) << faults_;
  expect_same_results("straight", "out");
}

TEST_F(RunResults, WhatIsRemovedDuringTheRunIsMissed) {
  for (const char* name : {"", "/history.csv", "/contacts.csv", "/.ashlar"}) {
    const std::string out = std::string("out") + (*name == '\0' ? "" : name + 1);
    EXPECT_EQ(run_during(out,
                         [&] {
                           // Frames come while the folder is being removed.
                           std::error_code again;
                           do {
                             std::filesystem::remove_all(folder_ / (out + name), again);
                           } while (again);
                         }),
              exit_status::failed)
        << name;
    EXPECT_THAT(faults_, AllOf(StartsWith("ashlar: error: results of step "),
                               HasSubstr("the last state could not be saved: ")))
        << name;
  }
}

TEST_F(RunResults, AnotherFolderInItsPlaceIsNotWrittenTo) {
  EXPECT_EQ(run_during("out",
                       [&] {
                         std::filesystem::rename(folder_ / "out", folder_ / "moved");
                         std::filesystem::create_directories(folder_ / "out/frames");
                       }),
            exit_status::failed);
  // The file that was being written when the folder changed may be the last.
  EXPECT_LE(files("out").size() - 1 + files("out/frames").size(), 1U);
}

// A limit on the size of files simulates a disk without space for the table.
TEST_F(RunResults, ATableThatCannotGrowEndsTheRunWithStateAndSummary) {
  ASSERT_EQ(run("straight", {"--set", "analysis.end_time=2"}), exit_status::done) << faults_;
  const std::uintmax_t whole = std::filesystem::file_size(folder_ / "straight/history.csv");
  {
    // More than reserve and checkpoint need, less than the table. The reserve is as large as the last checkpoint asks
    // for: without one on the way that does not depend on how fast the run is.
    const FileSizeLimit limit(whole * 3 / 4);
    ASSERT_EQ(run("out", {"--checkpoint", "1000", "--set", "analysis.end_time=2"}), exit_status::failed);
  }
  EXPECT_THAT(faults_, AllOf(StartsWith("ashlar: error: results of step "), HasSubstr("history.csv"),
                             HasSubstr("File too large"), HasSubstr("the last accepted state is in ")));
  const nlohmann::json failed = summary("out");
  EXPECT_EQ(failed["status"], "failed");
  const int steps = failed["steps"];
  EXPECT_EQ(lines("out/history.csv").size(), static_cast<std::size_t>(steps) + 1) << "without its last row";
  ASSERT_EQ(run("out", {"--resume", "--set", "analysis.end_time=2"}), exit_status::done) << faults_;
  expect_same_results("straight", "out");
}

TEST_F(RunResults, AFrameThatCannotBeWrittenIsWrittenWhenTheRunGoesOn) {
  for (const char* output : {"output.every=10", "output.interval=0.01"}) {
    const std::string key = std::string(output).substr(7, 5);
    ASSERT_EQ(run("straight" + key, {"--set", output}), exit_status::done) << faults_;
    const std::string out = "out" + key;
    ASSERT_EQ(run(out, {"--set", output, "--set", "analysis.end_time=0.005"}), exit_status::done) << faults_;
    for (const char* name : {"/frames/contacts_0000020.vtu", "/frames/blocks_0000030.vtu"}) {
      std::filesystem::create_directory(folder_ / (out + name));
      ASSERT_EQ(run(out, {"--resume", "--set", output}), exit_status::failed);
      EXPECT_THAT(faults_, AllOf(HasSubstr(name), HasSubstr("the last accepted state is in ")));
      EXPECT_EQ(summary(out)["status"], "failed");
      std::filesystem::remove(folder_ / (out + name));
    }
    ASSERT_EQ(run(out, {"--resume", "--set", output}), exit_status::done) << faults_;
    expect_same_results("straight" + key, out);
  }
}

TEST_F(RunResults, HistoryIsThinnedAndStillTheOneOfARunThatNeverStopped) {
  const auto thinned = [](std::vector<std::string> more) {
    more.insert(more.end(), {"--set", "output.history_every=7"});
    return more;
  };
  ASSERT_EQ(run("straight", thinned({})), exit_status::done) << faults_;
  EXPECT_THAT(column("straight/history.csv", "step"), ElementsAre(0, 7, 14, 21, 28, 35, 40));
  ASSERT_EQ(run("cut", thinned({"--set", "analysis.end_time=0.017"})), exit_status::done) << faults_;
  EXPECT_THAT(column("cut/history.csv", "step"), ElementsAre(0, 7, 14, 17));
  ASSERT_EQ(run("cut", thinned({"--resume"})), exit_status::done) << faults_;
  expect_same_results("straight", "cut");
  // Rows are those of the whole table.
  ASSERT_EQ(run("whole"), exit_status::done) << faults_;
  const std::vector<std::string> whole = lines("whole/history.csv"), some = lines("straight/history.csv");
  for (std::size_t k = 1; k + 1 < some.size(); ++k) EXPECT_EQ(some[k], whole[1 + 7 * (k - 1)]);
  EXPECT_EQ(some.back(), whole.back());
  EXPECT_EQ(run("bad", {"--set", "output.history_every=0"}), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("history_every is out of range (0)"));
}

TEST_F(RunResults, CheckpointsDoNotChangeResults) {
  ASSERT_EQ(run("straight"), exit_status::done) << faults_;
  ASSERT_EQ(run("saved", {"--checkpoint", "0"}), exit_status::done) << faults_;
  expect_same_results("straight", "saved");
  EXPECT_EQ(run("bad", {"--checkpoint", "-1"}), exit_status::bad_input);
}

TEST_F(RunResults, AKilledRunGoesOnFromItsFirstSecond) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) ::_exit(run("out", {"--checkpoint", "0", "--set", "analysis.end_time=1000"}));
  ASSERT_TRUE(wait_for_rows("out"));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  const std::size_t rows = lines("out/history.csv").size();
  const std::string end = "analysis.end_time=" + std::to_string(1e-3 * static_cast<double>(rows + 20));
  ASSERT_EQ(run("out", {"--resume", "--set", end}), exit_status::done) << faults_;
  ASSERT_EQ(run("straight", {"--set", end}), exit_status::done) << faults_;
  expect_same_results("straight", "out");
}

TEST_F(RunResults, TimesArePrintedAsMultiplesOfTheStep) {
  ASSERT_EQ(run("out", {"--set", "analysis.end_time=0.3", "--set", "output.every=1"}), exit_status::done)
      << faults_;
  const std::vector<std::string> rows = lines("out/history.csv");
  const std::string frames = text("out/blocks.pvd");
  ASSERT_EQ(rows.size(), 302U);
  for (int step = 1; step <= 300; ++step) {
    // "0.001", "0.01", "0.3"
    std::string time = std::to_string(1000 + step).substr(1);
    while (time.back() == '0') time.pop_back();
    time = "0." + time;
    EXPECT_THAT(rows[static_cast<std::size_t>(step) + 1],
                StartsWith(std::to_string(step) + "," + time + ","));
    EXPECT_THAT(frames, HasSubstr("timestep=\"" + time + "\""));
  }
}

}  // namespace
}  // namespace ashlar::run_results_test

// Runs with output.format = "vtkhdf": the same frames as in .vtu files, also after interrupts, kills and a full disk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "apps/results/frames/stored_frames.hpp"
#include "unit/apps/results/frames/hdf5_contents.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::vtkhdf_run_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class VtkhdfRun : public RunCommand {
 protected:
  int run_in_one_file(const std::string& out, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--set", "output.format=vtkhdf"});
    return run(out, std::move(more));
  }

  [[nodiscard]] std::filesystem::path file(const std::string& out) const {
    return folder_ / out / "results.vtkhdf";
  }

  void expect_same_frames(const std::string& a, const std::string& b) const {
    EXPECT_EQ(text(a + "/history.csv"), text(b + "/history.csv"));
    EXPECT_EQ(text(a + "/contacts.csv"), text(b + "/contacts.csv"));
    EXPECT_EQ(hdf5_contents(file(a)), hdf5_contents(file(b)));
    EXPECT_EQ(files(a), files(b));
  }

  /// Bytes of the frame as a .vtu file, without names of components, which one of the formats has.
  static std::string bytes_of(const StoredFrames& frames, const std::string& series, std::size_t k) {
    UnstructuredGrid grid = frames.read(series, k);
    grid.time = frames.time(series, k).time;
    for (auto* data : {&grid.point_data, &grid.cell_data})
      for (DataArray& array : *data) array.component_names.clear();
    return to_vtu(grid);
  }
};

TEST_F(VtkhdfRun, FramesAreThoseOfVtuFiles) {
  const std::vector<std::string> more = {"--set", "output.solid=true",      "--set", "output.every=1",
                                         "--set", "output.precision=double"};
  ASSERT_EQ(run("many", more), exit_status::done) << faults_;
  ASSERT_EQ(run_in_one_file("one", more), exit_status::done) << faults_;
  EXPECT_THAT(files("one"), ElementsAre(".ashlar", "checkpoint", "contacts.csv", "history.csv",
                                        "history.units.json", "results.vtkhdf", "summary.json"));
  const std::unique_ptr<StoredFrames> many = open_stored_frames(folder_ / "many");
  const std::unique_ptr<StoredFrames> one = open_stored_frames(folder_ / "one");
  for (const char* series : {"blocks", "surfaces", "contacts", "joints", "loads"}) {
    ASSERT_EQ(many->count(series), 41U);
    ASSERT_EQ(one->count(series), 41U);
    for (std::size_t k = 0; k < 41; ++k) {
      EXPECT_EQ(one->time(series, k).step, many->time(series, k).step);
      EXPECT_TRUE(bytes_of(*one, series, k) == bytes_of(*many, series, k)) << series << k;
    }
  }
  EXPECT_FALSE(one->has("bolts"));
}

TEST_F(VtkhdfRun, ThePageIsTheSame) {
  const auto page = [&](const std::string& out) {
    EXPECT_EQ(command({"view", (folder_ / out).string()}), exit_status::done) << faults_;
    const std::string whole = text(out + "/view.html"), mark = "<script id=\"frames\" type=\"text/plain\">";
    return whole.substr(whole.find(mark));
  };
  ASSERT_EQ(run("many", {"--set", "output.precision=single"}), exit_status::done) << faults_;
  ASSERT_EQ(run_in_one_file("one"), exit_status::done) << faults_;
  EXPECT_TRUE(page("one") == page("many"));
}

TEST_F(VtkhdfRun, GoesOnAsIfItHadNeverStopped) {
  ASSERT_EQ(run_in_one_file("straight"), exit_status::done) << faults_;
  ASSERT_EQ(run_in_one_file("cut", {"--set", "analysis.end_time=0.017"}), exit_status::done) << faults_;
  EXPECT_EQ(open_stored_frames(folder_ / "cut")->count("blocks"), 3U) << "steps 0, 10 and the last, 17";
  ASSERT_EQ(run_in_one_file("cut", {"--resume"}), exit_status::done) << faults_;
  expect_same_frames("straight", "cut");
}

TEST_F(VtkhdfRun, AKilledRunLeavesAReadableFileAndGoesOn) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0)
    ::_exit(run_in_one_file(
        "out", {"--checkpoint", "0", "--set", "output.every=1", "--set", "analysis.end_time=1000"}));
  for (int k = 0; k < 60000; ++k) {
    if (std::filesystem::exists(folder_ / "out/history.csv") && lines("out/history.csv").size() > 20) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  const std::size_t rows = lines("out/history.csv").size();
  ASSERT_GT(rows, 20U);
  EXPECT_GE(open_stored_frames(folder_ / "out")->count("blocks"), rows - 3);
  const std::string end = "analysis.end_time=" + std::to_string(1e-3 * static_cast<double>(rows + 20));
  ASSERT_EQ(run_in_one_file("out", {"--resume", "--set", "output.every=1", "--set", end}), exit_status::done)
      << faults_;
  ASSERT_EQ(run_in_one_file("straight", {"--set", "output.every=1", "--set", end}), exit_status::done)
      << faults_;
  expect_same_frames("straight", "out");
}

/// Files of this process cannot become larger while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
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

TEST_F(VtkhdfRun, AFrameThatDoesNotFitIsWrittenWhenTheRunGoesOn) {
  const std::string often = "output.every=1";
  ASSERT_EQ(run_in_one_file("straight", {"--set", often}), exit_status::done) << faults_;
  {
    const FileSizeLimit limit(std::filesystem::file_size(file("straight")) * 2 / 3);
    ASSERT_EQ(run_in_one_file("out", {"--set", often}), exit_status::failed);
  }
  EXPECT_THAT(faults_, HasSubstr("File too large"));
  EXPECT_THAT(files("out"), Not(Contains(StartsWith("results.vtkhdf."))));
  const std::size_t frames = open_stored_frames(folder_ / "out")->count("blocks");
  EXPECT_GT(frames, 1U);
  EXPECT_LT(frames, 41U);
  ASSERT_EQ(run_in_one_file("out", {"--resume", "--set", often}), exit_status::done) << faults_;
  expect_same_frames("straight", "out");
}

TEST_F(VtkhdfRun, FilesOfTheOtherFormatAreRemoved) {
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  ASSERT_EQ(run_in_one_file("out", {"--force"}), exit_status::done) << faults_;
  EXPECT_THAT(files("out"), ElementsAre(".ashlar", "checkpoint", "contacts.csv", "history.csv",
                                        "history.units.json", "results.vtkhdf", "summary.json"));
  ASSERT_EQ(run("out", {"--force"}), exit_status::done) << faults_;
  EXPECT_THAT(files("out"),
              ElementsAre(".ashlar", "blocks.pvd", "checkpoint", "contacts.csv", "contacts.pvd", "frames",
                          "history.csv", "history.units.json", "joints.pvd", "loads.pvd", "summary.json"));
}

TEST_F(VtkhdfRun, AFileThatWasReplacedEndsTheRun) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) ::_exit(run_in_one_file("out", {"--set", "analysis.end_time=1000"}));
  for (int k = 0; k < 60000 && !std::filesystem::exists(folder_ / "out/summary.json"); ++k) {
    const bool begun =
        std::filesystem::exists(folder_ / "out/history.csv") && lines("out/history.csv").size() > 20;
    if (begun && std::filesystem::exists(file("out"))) std::filesystem::remove(file("out"));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), exit_status::failed);
}

TEST_F(VtkhdfRun, AWrongFormatIsToldWithTheAllowedOnes) {
  EXPECT_EQ(run("bad", {"--set", "output.format=xdmf"}), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("xdmf"));
  EXPECT_THAT(faults_, HasSubstr("vtkhdf"));
}

}  // namespace
}  // namespace ashlar::vtkhdf_run_test

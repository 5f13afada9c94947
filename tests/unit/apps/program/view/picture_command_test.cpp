// Errors of `ashlar picture`; the pictures themselves are tested in tests/browser.
#include "apps/program/view/picture_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "support/temporary_folder.hpp"

namespace ashlar::picture_command_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* scene_text = R"([analysis]
end_time = 0.1
time_step = 0.1
gravity = [0, 0, 0]
[[material]]
name = "rock"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "A"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
)";

struct PictureCommand : ::testing::Test {
  TemporaryFolder folder;
  std::ostringstream out;
  std::ostringstream err;

  void SetUp() override {
    write_text(folder / "s.toml", scene_text);
    ASSERT_EQ(run_command_line({"run", path("s.toml"), "--out", path("out"), "--quiet"}, out, err),
              exit_status::done)
        << err.str();
    ::setenv("ASHLAR_BROWSER", "/bin/false", 1);
  }
  void TearDown() override { ::unsetenv("ASHLAR_BROWSER"); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
  int picture(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"picture", path("out"), "-o", path("p.png")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_command_line(arguments, out, err);
  }
};

TEST_F(PictureCommand, RefusesOtherSizes) {
  for (const char* size : {"800", "800x", "x600", "800x600x3", "15x600", "800x8193", "-80x60", "80 x60"}) {
    EXPECT_EQ(picture({"--size", size}), exit_status::bad_input) << size;
    EXPECT_THAT(err.str(), HasSubstr(std::string("size (") + size + ")"));
  }
}

TEST_F(PictureCommand, RefusesWhatIsNoDirection) {
  for (const char* from : {"0,0,0", "1,2", "1,2,3,4", "1,2,z", "inf,0,0", "nan,0,0", ""}) {
    EXPECT_EQ(picture({std::string("--from=") + from}), exit_status::bad_input) << from;
  }
}

TEST_F(PictureCommand, RefusesPointsAndSizesThatAreNone) {
  EXPECT_EQ(picture({"--at=1,2"}), exit_status::bad_input);
  EXPECT_THAT(err.str(), HasSubstr("malformed point (1,2); give x,y,z"));
  for (const char* option : {"--zoom=0", "--zoom=-1", "--zoom=nan", "--scale=0", "--time-limit=0"})
    EXPECT_EQ(picture({option}), exit_status::bad_input) << option;
  EXPECT_THAT(err.str(), HasSubstr("time limit is not positive (0); give more than 0"));
}

TEST_F(PictureCommand, RefusesSectionsRangesAndNamesThatAreNone) {
  for (const char* section : {"x", "x,", "w,0.5", "x,0.5,1", "--x,1", "x,inf", ",1"}) {
    EXPECT_EQ(picture({std::string("--section=") + section}), exit_status::bad_input) << section;
    EXPECT_THAT(err.str(),
                HasSubstr(std::string("malformed section (") + section + "); give an axis and a place"));
  }
  for (const char* range : {"1", "1,1", "2,1", "0,inf", "a,b", "0,1,2"})
    EXPECT_EQ(picture({std::string("--range=") + range}), exit_status::bad_input) << range;
  EXPECT_EQ(picture({"--hide", "A&x=1"}), exit_status::bad_input);
  EXPECT_EQ(picture({"--joints", "gap"}), exit_status::bad_input);
  EXPECT_EQ(picture({"--from", "above"}), exit_status::bad_input);
  EXPECT_THAT(
      err.str(),
      HasSubstr(
          "malformed direction (above); give x,y,z, not all zero, or front, back, left, right, top, iso"));
}

TEST_F(PictureCommand, RefusesUnknownColoursAndFrames) {
  EXPECT_EQ(picture({"--color", "temperature"}), exit_status::bad_input);
  EXPECT_EQ(picture({"--contacts", "all"}), exit_status::bad_input);
  EXPECT_EQ(picture({"--frame", "2"}), exit_status::bad_input);
  EXPECT_THAT(err.str(), HasSubstr("no frame 2, the last one is 1"));
}

TEST_F(PictureCommand, RefusesFramesBelowZero) {
  EXPECT_EQ(picture({"--frame", "-1"}), exit_status::bad_input);
  EXPECT_THAT(err.str(),
              HasSubstr("--frame: value is no number of this kind (-1), a whole number of at least 0"));
}

TEST_F(PictureCommand, WritesPngOnly) {
  EXPECT_EQ(run_command_line({"picture", path("out"), "-o", path("p.jpg")}, out, err),
            exit_status::bad_input);
  EXPECT_THAT(err.str(), HasSubstr("p.jpg); give a name that ends with .png"));
}

TEST_F(PictureCommand, ABrowserThatFailsIsNamed) {
  EXPECT_EQ(picture({}), exit_status::failed);
  EXPECT_THAT(err.str(), HasSubstr("/bin/false failed"));
  ::setenv("ASHLAR_BROWSER", "/bin/true", 1);
  EXPECT_EQ(picture({}), exit_status::failed);
  EXPECT_THAT(err.str(), HasSubstr("/bin/true made no picture"));
  ::setenv("ASHLAR_BROWSER", path("none").c_str(), 1);
  EXPECT_EQ(picture({}), exit_status::failed);
  EXPECT_THAT(err.str(), HasSubstr("cannot start"));
  EXPECT_FALSE(std::filesystem::exists(folder / "p.png"));
}

TEST_F(PictureCommand, ABrowserThatHangsIsEndedWithAllItStarted) {
  write_text(folder / "hang", "#!/bin/sh\nsleep 600 &\necho $! > " + path("child") + "\nwait\n");
  std::filesystem::permissions(folder / "hang", std::filesystem::perms::owner_all);
  ::setenv("ASHLAR_BROWSER", path("hang").c_str(), 1);
  EXPECT_EQ(picture({"--time-limit", "2"}), exit_status::failed);
  EXPECT_THAT(err.str(), HasSubstr("hang did not finish within 2 s and was ended"));
  // A process without a waiting parent is a zombie ("Z") until init waits for it.
  const std::string stat = "/proc/" + std::to_string(std::stoi(read_text(folder / "child"))) + "/stat";
  const auto running = [&] {
    std::ifstream file(stat);
    std::string state;
    std::getline(file, state);
    return !state.empty() && state.find(") Z") == std::string::npos;
  };
  for (int k = 0; running() && k < 500; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(running());
}

}  // namespace
}  // namespace ashlar::picture_command_test

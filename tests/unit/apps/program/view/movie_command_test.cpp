// Errors of `ashlar movie`, and its arguments for ffmpeg; scripts replace the browser and ffmpeg.
#include "apps/program/view/movie_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::movie_command_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct MovieCommand : RunCommand {
  std::string path_before = ::getenv("PATH");

  void SetUp() override { ASSERT_EQ(run("out"), exit_status::done) << faults_; }
  void TearDown() override {
    ::setenv("PATH", path_before.c_str(), 1);
    ::unsetenv("ASHLAR_BROWSER");
  }
  void program(const std::string& name, const std::string& script) {
    write_text(folder_ / name, "#!/bin/sh\n" + script);
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
  }
  int movie(const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"movie", (folder_ / "out").string(), "-o",
                                          (folder_ / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return command(arguments);
  }
};

TEST_F(MovieCommand, GivesFfmpegTheFramesInOrder) {
  ::setenv("ASHLAR_BROWSER", (folder_ / "browser").c_str(), 1);
  ::setenv("PATH", (folder_.path().string() + ":" + path_before).c_str(), 1);
  // The last argument of the browser is the address; base64 of "first" and "second".
  program("browser",
          "for address; do :; done\ncase \"$address\" in *frames=1:2*) ;; *) exit 1;; esac\n"
          "printf '<html><pre id=\"pictures\">1 Zmlyc3Q=\n2 c2Vjb25k</pre></html>'\n");
  program("ffmpeg",
          "for last; do :; done\nfolder=$(dirname \"$last\")\n"
          "{ cat \"$folder\"/frame_*.png; echo; echo \"$@\"; } > \"$last\"\n");
  ASSERT_EQ(movie("film.mp4", {"--frames", "1:2", "--rate", "10"}), exit_status::done) << faults_;
  EXPECT_THAT(text("film.mp4"), AllOf(HasSubstr("firstsecond\n"), HasSubstr("-framerate 10 "),
                                      HasSubstr("libx264"), HasSubstr("yuv420p")));
  EXPECT_THAT(printed_, HasSubstr("(2 frames, 0.2 s)"));
}

TEST_F(MovieCommand, PicturesOfFramesAreNumbered) {
  ::setenv("ASHLAR_BROWSER", (folder_ / "browser").c_str(), 1);
  program("browser", "printf '<html><pre id=\"pictures\">1 Zmlyc3Q=\n2 c2Vjb25k</pre></html>'\n");
  ASSERT_EQ(
      command({"picture", (folder_ / "out").string(), "--frames", "1:2", "-o", (folder_ / "p.png").string()}),
      exit_status::done)
      << faults_;
  EXPECT_EQ(text("p_0001.png"), "first");
  EXPECT_EQ(text("p_0002.png"), "second");
}

TEST_F(MovieCommand, RefusesOtherFilmsRatesAndFrames) {
  ::setenv("ASHLAR_BROWSER", "/bin/false", 1);
  ::setenv("PATH", (folder_.path().string() + ":" + path_before).c_str(), 1);
  program("ffmpeg", "exit 0\n");
  EXPECT_EQ(movie("film.avi"), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("use .mp4, .webp or .gif"));
  EXPECT_EQ(movie("film.mp4", {"--rate", "0"}), exit_status::bad_input);
  for (const char* frames : {"3", "2:1", "0:5", "a:b", "0:1:2"}) {
    EXPECT_EQ(movie("film.mp4", {"--frames", frames}), exit_status::bad_input) << frames;
    EXPECT_THAT(faults_, HasSubstr("give A:B with 0 <= A <= B <= 4"));
  }
  EXPECT_EQ(movie("film.mp4"), exit_status::failed) << "the browser fails";
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film.mp4"));
}

TEST_F(MovieCommand, SaysWhatIsMissing) {
  ::setenv("PATH", folder_.path().c_str(), 1);
  EXPECT_EQ(movie("film.gif"), exit_status::failed);
  EXPECT_THAT(faults_, AllOf(HasSubstr("no ffmpeg in PATH"), HasSubstr("apt-get install ffmpeg")));
}

}  // namespace
}  // namespace ashlar::movie_command_test

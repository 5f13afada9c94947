// What `ashlar picture` refuses; the pictures themselves are tested in tests/browser.
#include "apps/picture_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <sstream>

#include "support/temporary_folder.hpp"

namespace ashlar {
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

TEST_F(PictureCommand, RefusesUnknownColoursAndFrames) {
  EXPECT_EQ(picture({"--color", "temperature"}), exit_status::bad_input);
  EXPECT_EQ(picture({"--frame", "2"}), exit_status::bad_input);
  EXPECT_THAT(err.str(), HasSubstr("no frame 2, the last one is 1"));
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

}  // namespace
}  // namespace ashlar

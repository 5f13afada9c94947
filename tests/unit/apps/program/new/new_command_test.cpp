#include "apps/program/new/new_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "apps/program/new/starting_scenes.hpp"
#include "apps/results/text/json_text.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::new_command_test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

/// The scene with its optional parts: commented lines that begin with a key or a table of a list.
std::string with_options(const std::string& text) {
  const auto is_toml = [](std::string_view line) {
    const std::size_t end = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz_");
    return line.starts_with("[[") || (end > 0 && end != line.npos && line.substr(end).starts_with(" = "));
  };
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("# ") && is_toml(std::string_view(line).substr(2))) line.erase(0, 2);
    result += line + "\n";
  }
  return result;
}

class NewScene : public ::testing::Test {
 protected:
  int write(const std::string& kind, bool force = false) {
    printed_.str("");
    faults_.str("");
    return new_command({kind, folder_ / (kind + ".toml"), force}, printed_, faults_);
  }

  /// Runs the scene, and returns its summary.
  Json answer_of(const std::string& kind, std::vector<std::string> more = {}) {
    EXPECT_EQ(write(kind, true), exit_status::done) << faults_.str();
    std::vector<std::string> arguments = {"run",     (folder_ / (kind + ".toml")).string(),
                                          "--out",   (folder_ / "out").string(),
                                          "--force", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run_command_line(arguments, printed_, faults_), exit_status::done) << faults_.str();
    return parse_json(read_text(folder_ / "out" / "summary.json"));
  }

  TemporaryFolder folder_;
  std::ostringstream printed_, faults_;
};

TEST_F(NewScene, EachIsGoodAlsoWithWhatItsCommentsOffer) {
  for (const StartingScene& scene : starting_scenes()) {
    const std::string kind(scene.kind);
    ASSERT_EQ(write(kind), exit_status::done) << faults_.str();
    EXPECT_THAT(printed_.str(), HasSubstr("ashlar run '" + (folder_ / (kind + ".toml")).string() + "'"));
    const std::string text = read_text(folder_ / (kind + ".toml"));
    EXPECT_TRUE(text.starts_with("#:schema scene.schema.json\n"));
    write_text(folder_ / "all.toml", with_options(text));
    for (const std::string& file : {std::string("all.toml"), kind + ".toml"}) {
      std::ostringstream out, err;
      EXPECT_EQ(run_command_line({"check", (folder_ / file).string()}, out, err), exit_status::done)
          << kind << err.str();
      EXPECT_THAT(out.str() + err.str(), ::testing::Not(HasSubstr("warning"))) << kind;
    }
  }
  EXPECT_THAT(read_text(folder_ / "scene.schema.json"), HasSubstr("\"Ashlar scene\""));
}

TEST_F(NewScene, NothingElseIsReplaced) {
  EXPECT_EQ(write("slop"), exit_status::bad_input);
  EXPECT_THAT(faults_.str(), HasSubstr("unknown kind of scene (slop), did you mean slope?"));
  EXPECT_EQ(new_command({"wall", "-"}, printed_, faults_), exit_status::bad_input);
  write_text(folder_ / "wall.toml", "mine");
  EXPECT_EQ(write("wall"), exit_status::bad_input);
  EXPECT_EQ(read_text(folder_ / "wall.toml"), "mine");
  EXPECT_EQ(write("wall", true), exit_status::done);
  write_text(folder_ / "scene.schema.json", "mine");
  EXPECT_EQ(write("arch"), exit_status::bad_input);
  EXPECT_EQ(read_text(folder_ / "scene.schema.json"), "mine");
}

// Plane slide without cohesion: F = tan(phi) / tan(dip).
TEST_F(NewScene, TheSlopeHasItsFactor) {
  const Json factor = answer_of("slope").at("factor_of_safety");
  const double expected = std::tan(std::numbers::pi / 6.0) / std::tan(35.0 * std::numbers::pi / 180.0);
  EXPECT_LT(factor.at("lower"), expected * (1.0 + 1e-6));
  EXPECT_GT(factor.at("upper"), expected * (1.0 - 1e-6));
}

// The wall overturns about its edge at density g t^2 / h = 8.175 times 100 Pa.
TEST_F(NewScene, TheWallOverturns) {
  const Json factor = answer_of("wall").at("load_factor");
  const double expected = 2000 * 9.81 * 0.25 * 0.25 / 1.5 / 100;
  EXPECT_LT(factor.at("lower"), expected);
  EXPECT_GT(factor.at("upper"), expected);
}

// A semicircle stands from a thickness of 0.1075 of its radius on (Milankovitch 1907): 0.32 m.
TEST_F(NewScene, TheArchStandsIfItIsThickEnough) {
  EXPECT_EQ(answer_of("arch").at("status"), "equilibrium");
  EXPECT_EQ(answer_of("arch", {"--set", "parameters.thickness=0.3"}).at("status"), "moving");
}

TEST_F(NewScene, TheTunnelHasBlocksThatFall) {
  const Json summary = answer_of("tunnel");
  EXPECT_EQ(summary.at("status"), "moving");
}

}  // namespace
}  // namespace ashlar::new_command_test

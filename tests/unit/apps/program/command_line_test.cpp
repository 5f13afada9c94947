#include "apps/program/command_line.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <iostream>
#include <sstream>

#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::command_line_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Outcome {
  int status;
  std::string out;
  std::string err;
};

Outcome run(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int status = run_command_line(arguments, out, err);
  return {status, out.str(), err.str()};
}

TEST(CommandLine, HelpIsEverywhereAndNoFault) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"run", "--help"}, {"check", "--help"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, exit_status::done);
    EXPECT_THAT(outcome.out, HasSubstr("Usage: ashlar"));
    EXPECT_EQ(outcome.err, "");
  }
}

TEST(CommandLine, VersionNamesProgramCompilerAndLibraries) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.status, exit_status::done);
  EXPECT_THAT(outcome.out,
              AllOf(StartsWith("ashlar "), HasSubstr("CGAL 5."), HasSubstr("Eigen 3."), HasSubstr("CHOLMOD "),
                    ::testing::AnyOf(HasSubstr("GCC "), HasSubstr("Clang "))));
}

TEST(CommandLine, UsageFaultsGoToErrAndEndWithTwo) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--quiet"}, "subcommand is required"},
      {{"chek", "a.toml"}, "unknown command (chek), did you mean check?"},
      {{"check"}, "SCENE is required"},
      {{"contacts", "a.off"}, "a second mesh B is required"},
      {{"check", "a.toml", "b.toml"}, "b.toml"},
      {{"run", "a.toml", "--fast"}, "--fast"},
      {{"run", "a.toml", "--threads", "0"}, "--threads"},
      {{"run", "a.toml", "--threads", "two"}, "--threads"},
      {{"run", "a.toml", "--set"}, "--set"},
  };
  for (const auto& [arguments, expected] : cases) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, exit_status::bad_input) << expected;
    EXPECT_THAT(outcome.err, AllOf(StartsWith("ashlar: error: "), HasSubstr(expected)));
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(CommandLine, WithoutACommandItListsThem) {
  const Outcome outcome = run({});
  EXPECT_EQ(outcome.status, exit_status::bad_input);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("\n  run "), HasSubstr("\n  new ")));
}

TEST(CommandLine, CheckSaysWhatAGoodSceneHolds) {
  const TemporaryFolder folder;
  const std::string file = (folder / "s.toml").string();
  write_text(file, sample());
  const Outcome outcome = run({"check", file});
  EXPECT_EQ(outcome.status, exit_status::done);
  EXPECT_EQ(outcome.out, file +
                             ": good: 2 blocks, 1 material, 1 joint, 1 measure\n"
                             "estimate: 2 blocks, 24 sub-faces, 24 unknowns, 1 pair of near blocks, 20 MB\n");
  EXPECT_EQ(outcome.err, "");
}

TEST(CommandLine, CheckListsEveryFaultAndWritesNothing) {
  const TemporaryFolder folder;
  const std::string file = (folder / "s.toml").string();
  write_text(file, sample_with(10, "density = -1"));
  const Outcome outcome = run({"check", file, "--set", "block.A.order=-1", "--set", "block.B.order=13"});
  EXPECT_EQ(outcome.status, exit_status::bad_input);
  EXPECT_EQ(outcome.err,
            file + ":10:11: error: density is out of range (-1), a number > 0 is needed\n" +
                "--set block.A.order=-1: error: order is out of range (-1), a whole number from 0 to 12 or "
                "\"auto\" is needed\n" +
                "--set block.B.order=13: error: order is out of range (13), a whole number from 0 to 12 or "
                "\"auto\" is needed\n");
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(folder.entry_count(), 1u);
}

TEST(CommandLine, OutputThatCannotBeWrittenIsAFailure) {
  std::ostringstream out, err;
  out.setstate(std::ios::badbit);
  EXPECT_EQ(run_command_line({"verify", "--list"}, out, err), exit_status::failed);
  EXPECT_EQ(err.str(), "ashlar: error: standard output cannot be written\n");
}

TEST(CommandLine, RunOfABadSceneEndsWithTwoAndLeavesNoFolder) {
  const TemporaryFolder folder;
  const std::string file = (folder / "s.toml").string();
  write_text(file, sample_with(10, "density = -1"));
  EXPECT_EQ(run({"run", file, "--quiet", "--out", (folder / "out").string()}).status, exit_status::bad_input);
  EXPECT_EQ(folder.entry_count(), 1u);
}

TEST(CommandLine, HelpIsACommandToo) {
  EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
  EXPECT_EQ(run({"help"}).status, exit_status::done);
  EXPECT_EQ(run({"help", "run"}).out, run({"run", "--help"}).out);
}

TEST(CommandLine, RunHasShortOptions) {
  const TemporaryFolder folder;
  write_text(folder / "s.toml", sample_with(2, "end_time = 0.01"));
  const Outcome outcome =
      run({"run", (folder / "s.toml").string(), "-o", (folder / "out").string(), "-t", "2", "--quiet"});
  EXPECT_EQ(outcome.status, exit_status::done) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/summary.json"));
}

TEST(CommandLine, ScenesComeFromStandardInput) {
  std::istringstream input(sample_with(2, "end_time = -1"));
  std::streambuf* const before = std::cin.rdbuf(input.rdbuf());
  const Outcome bad = run({"check", "-"});
  std::istringstream good(sample());
  std::cin.rdbuf(good.rdbuf());
  const Outcome outcome = run({"check", "-"});
  std::cin.rdbuf(before);
  EXPECT_EQ(bad.status, exit_status::bad_input);
  EXPECT_THAT(bad.err, StartsWith("(standard input):2:12: error: end_time is out of range"));
  EXPECT_EQ(outcome.status, exit_status::done) << outcome.err;
}

}  // namespace
}  // namespace ashlar::test::command_line_test

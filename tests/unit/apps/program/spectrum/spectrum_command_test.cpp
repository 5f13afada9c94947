#include "apps/program/spectrum/spectrum_command.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "apps/results/text/csv_text.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::spectrum_command_test {
namespace {

using ::testing::HasSubstr;

class SpectrumCommand : public ::testing::Test {
 protected:
  int run(SpectrumOptions options) {
    out_.str("");
    err_.str("");
    return spectrum_command(options, out_, err_);
  }

  /// Pseudo-accelerations of the table.
  [[nodiscard]] std::vector<double> accelerations() const {
    std::istringstream lines(out_.str());
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "period,displacement,pseudo_velocity,pseudo_acceleration");
    std::vector<double> values;
    while (std::getline(lines, line)) values.push_back(csv_number(split_csv_line(line).at(3)).value());
    return values;
  }

  SpectrumOptions undamped(const std::filesystem::path& input) const {
    SpectrumOptions options;
    options.input = input;
    options.damping = 0.0;
    options.shortest = 0.1;
    options.longest = 1.0;
    options.periods = 3;
    return options;
  }

  TemporaryFolder folder_;
  std::ostringstream out_, err_;
};

// A constant acceleration moves an undamped oscillator to twice its place of rest.
TEST_F(SpectrumCommand, OfARecordInG) {
  write_text(folder_ / "r.txt", "0 0.5\n10 0.5\n");
  SpectrumOptions options = undamped(folder_ / "r.txt");
  options.scale = "g";
  ASSERT_EQ(run(options), exit_status::done) << err_.str();
  const std::vector<double> found = accelerations();
  ASSERT_EQ(found.size(), 3U);
  for (const double value : found) EXPECT_NEAR(value, 9.80665, 1e-3);
  options.baseline = 0;
  ASSERT_EQ(run(options), exit_status::done) << err_.str();
  for (const double value : accelerations()) EXPECT_NEAR(value, 0.0, 1e-12);
}

TEST_F(SpectrumCommand, OfAMeasureFromItsVelocity) {
  std::filesystem::create_directory(folder_ / "run");
  write_text(folder_ / "run/history.csv",
             "step,time,dt,top.vx,stage\n0,0,1,0,1\n1,1,1,9,1\n2,0,1,9,2\n3,5,1,19,2\n4,10,1,29,2\n");
  SpectrumOptions options = undamped(folder_ / "run");
  options.column = "top.vx";
  ASSERT_EQ(run(options), exit_status::done) << err_.str();
  for (const double value : accelerations()) EXPECT_NEAR(value, 4.0, 4e-4);
  options.stage = 1;
  ASSERT_EQ(run(options), exit_status::done) << err_.str();
  for (const double value : accelerations()) EXPECT_NEAR(value, 18.0, 2e-3);
}

TEST_F(SpectrumCommand, WritesATableAndAPicture) {
  write_text(folder_ / "r.csv", "time,a\n0,1\n1,1\n");
  SpectrumOptions options = undamped(folder_ / "r.csv");
  options.column = "a";
  options.out = folder_ / "s.csv";
  ASSERT_EQ(run(options), exit_status::done) << err_.str();
  EXPECT_THAT(read_text(folder_ / "s.csv"), HasSubstr("period,displacement"));
  EXPECT_THAT(read_text(folder_ / "s.svg"), HasSubstr("pseudo-acceleration"));
}

TEST_F(SpectrumCommand, FilesOfOthersAreKept) {
  write_text(folder_ / "r.txt", "0 0.5\n10 0.5\n");
  SpectrumOptions options = undamped(folder_ / "r.txt");
  for (const char* name : {"x.csv", "x.py", "x.svg", "x.png"}) {
    const TemporaryFolder folder;
    options.out = folder / "x.csv";
    write_text(folder / name, "time,a\n0,1\n");
    EXPECT_EQ(run(options), exit_status::bad_input) << name;
    EXPECT_THAT(err_.str(), HasSubstr(std::string(name) + " is in the way: it is no "));
    EXPECT_EQ(read_text(folder / name), "time,a\n0,1\n");
    EXPECT_EQ(folder.entry_count(), 1U) << name;
  }
}

TEST_F(SpectrumCommand, FaultsOfInput) {
  SpectrumOptions options = undamped(folder_ / "none.csv");
  EXPECT_EQ(run(options), exit_status::bad_input);
  EXPECT_THAT(err_.str(), HasSubstr("there is no such file"));
  std::filesystem::create_directory(folder_ / "run");
  write_text(folder_ / "run/history.csv", "step,time,dt,top.vx\n0,0,1,0\n1,1,1,9\n");
  options = undamped(folder_ / "run");
  options.column = "top.ux";
  EXPECT_EQ(run(options), exit_status::bad_input);
  EXPECT_THAT(err_.str(), HasSubstr("--column is no velocity of a measured point (\"top.ux\")"));
  options.column = "tip.vx";
  EXPECT_EQ(run(options), exit_status::bad_input);
  EXPECT_THAT(err_.str(),
              HasSubstr("history.csv:1:1: error: no column of that name (\"tip.vx\"), did you mean"));
  options.column = "top.vx";
  options.stage = 2;
  EXPECT_EQ(run(options), exit_status::bad_input);
  write_text(folder_ / "r.csv", "time,a\n0,1\n1,1\n");
  options = undamped(folder_ / "r.csv");
  options.scale = "m";
  EXPECT_EQ(run(options), exit_status::bad_input);
  EXPECT_THAT(err_.str(), HasSubstr("--scale is no number (\"m\")"));
}

}  // namespace
}  // namespace ashlar::spectrum_command_test

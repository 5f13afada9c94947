#include "apps/program/plot/plot_script.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "support/temporary_folder.hpp"

namespace ashlar::plot_script_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(PlotScript, HoldsWhatIsDrawn) {
  const std::string text =
      plot_script({"it's \"$a$\"", "x", "y", {{"s", {1, 10, -1, 3, 100}, {1e-4, 1e-2, 5, std::nan(""), 1}}}});
  EXPECT_THAT(text, HasSubstr(plot_script_mark));
  // A text of JSON in a text of Python. Points without logarithms are left out; from 1 to 100 the slope is 2.
  EXPECT_THAT(text, HasSubstr(R"(\"x\":[1.0,10.0,100.0],\"y\":[0.0001,0.01,1.0])"));
  EXPECT_THAT(text, HasSubstr(R"(\"s, slope 2.00\")"));
  EXPECT_THAT(text, HasSubstr(R"(it's \\\"$a$\\\")"));
  Plot plot{"t", "x", "y", {{"s", {-1, 2}, {0, 3}}}, false};
  plot.axes = PlotAxes::linear;
  EXPECT_THAT(plot_script(plot), HasSubstr(R"(\"x\":[-1.0,2.0],\"y\":[0.0,3.0])"));
  EXPECT_THAT(plot_script(plot), Not(HasSubstr("s, slope")));
}

TEST(PlotScript, WithoutAnInterpreterItIsStillThere) {
  const TemporaryFolder folder;
  ::setenv("ASHLAR_PYTHON", "/bin/false", 1);
  const std::string told = write_plot({"t", "x", "y", {{"s", {1, 2}, {3, 4}}}}, folder / "p.svg", true);
  ::unsetenv("ASHLAR_PYTHON");
  EXPECT_EQ(told, "no picture: /bin/false: failed; python3 with matplotlib draws it by " +
                      (folder / "p.py").string() + "\n");
  EXPECT_TRUE(std::filesystem::exists(folder / "p.py"));
  EXPECT_FALSE(std::filesystem::exists(folder / "p.svg"));
}

TEST(PlotScript, DrawsEachPoint) {
  const TemporaryFolder folder;
  for (const bool linear : {false, true}) {
    Plot plot{"a < b", "x of $", "y", {{"s", {1, 10, 100}, {1e-4, 1e-2, 1}}, {"t", {2}, {3}, true}}};
    plot.axes = linear ? PlotAxes::linear : PlotAxes::logarithmic;
    const std::string told = write_plot(plot, folder / "p.png", true);
    if (told.starts_with("no picture")) GTEST_SKIP() << told;
    EXPECT_EQ(told,
              "picture: " + (folder / "p.svg").string() + "\npicture: " + (folder / "p.png").string() + "\n");
    const std::string svg = read_text(folder / "p.svg");
    EXPECT_TRUE(svg.starts_with("<svg"));
    EXPECT_THAT(svg, HasSubstr(">a &lt; b<"));
    EXPECT_THAT(svg, HasSubstr(">x of $<"));
    EXPECT_THAT(svg, HasSubstr(">s, slope 2.00<"));
    const auto size = std::filesystem::file_size(folder / "p.png");
    (void)write_plot(plot, folder / "p.png", false);
    EXPECT_EQ(read_text(folder / "p.svg"), svg) << "equal plots make equal files";
    EXPECT_EQ(std::filesystem::file_size(folder / "p.png"), size);
  }
}

TEST(PlotScript, FilesOfOthersAreKept) {
  const Plot plot{"t", "x", "y", {{"s", {1, 2}, {3, 4}}}};
  for (const char* name : {"p.py", "p.svg", "p.png"}) {
    const TemporaryFolder folder;
    write_text(folder / name, "precious");
    EXPECT_THROW((void)write_plot(plot, folder / "p.csv", true), std::invalid_argument) << name;
    EXPECT_EQ(read_text(folder / name), "precious");
    EXPECT_EQ(folder.entry_count(), 1U) << name;
  }
}

TEST(PlotScript, APlotWithoutPointsIsStillAPicture) {
  const TemporaryFolder folder;
  const std::string told = write_plot({"empty", "x", "y", {{"nothing", {}, {}}}}, folder / "p.svg", false);
  if (told.starts_with("no picture")) GTEST_SKIP() << told;
  EXPECT_THAT(read_text(folder / "p.svg"), HasSubstr(">empty<"));
}

}  // namespace
}  // namespace ashlar::plot_script_test

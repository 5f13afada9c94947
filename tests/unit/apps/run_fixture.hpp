// `ashlar run` and other commands on a small scene in a folder of the test's own.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar {

// A cube of 450 kg set on a clamped beam with 0.5 m/s: springs of 1.25e7 N/m throw it back after some 19 ms.
inline constexpr const char* scene_text = R"(title = "test"
[analysis]
end_time = 0.04
time_step = 1e-3
[contact]
normal_stiffness = 5e7
shear_stiffness = 5e7
friction_angle = 30
[[material]]
name = "rock"
density = 3600
young_modulus = 5e8
poisson_ratio = 0.2
[[block]]
name = "A"
material = "rock"
box = { min = [3.0, -0.25, 0.5], max = [3.5, 0.25, 1.0] }
velocity = [0.1, 0, -0.5]
[[block]]
name = "B"
material = "rock"
order = 2
box = { min = [0, -0.5, -0.5], max = [4, 0.5, 0.5] }
[[block.fix]]
plane = { point = [0, 0, 0], normal = [-1, 0, 0] }
[[measure]]
name = "tip"
block = "B"
point = [4, 0, 0]
[output]
every = 10
)";

// Rock of 2000 kg/m^3, for scenes of a test's own.
inline constexpr const char* rock_text = R"([[material]]
name = "rock"
density = 2000
young_modulus = 1e10
poisson_ratio = 0.2
)";

// A stone whose sides lean by 30 degrees, wider at its top, between two fixed ones.
inline std::string keystone(const std::string& analysis, const std::string& contact) {
  return "[analysis]\n" + analysis + "\n[contact]\n" + contact + "\n" + rock_text + R"toml([[block]]
name = "stone"
material = "rock"
hull.points = [
  [-0.5, 0, 0], [0.5, 0, 0], ["= 0.5 + tan(30*deg)", 0, 1], ["= -0.5 - tan(30*deg)", 0, 1],
  [-0.5, 1, 0], [0.5, 1, 0], ["= 0.5 + tan(30*deg)", 1, 1], ["= -0.5 - tan(30*deg)", 1, 1]
]
[[block]]
name = "left"
fixed = true
hull.points = [
  [-0.5, 0, 0], ["= -0.5 - tan(30*deg)", 0, 1], [-3, 0, 1], [-3, 0, 0],
  [-0.5, 1, 0], ["= -0.5 - tan(30*deg)", 1, 1], [-3, 1, 1], [-3, 1, 0]
]
[[block]]
name = "right"
fixed = true
hull.points = [
  [0.5, 0, 0], ["= 0.5 + tan(30*deg)", 0, 1], [3, 0, 1], [3, 0, 0],
  [0.5, 1, 0], ["= 0.5 + tan(30*deg)", 1, 1], [3, 1, 1], [3, 1, 0]
]
)toml";
}

// A plate of 2 m x 2 m x 0.5 m of that rock on a slope of 30 degrees: its weight meets the slope in its middle third.
inline constexpr const char* plate_text = R"([[block]]
name = "slope"
fixed = true
box = { min = [-9, -4, -1], max = [9, 4, 0] }
rotate = { axis = [0, -1, 0], angle = 30 }
[[block]]
name = "stone"
material = "rock"
box = { min = [-1, -1, 0], max = [1, 1, 0.5] }
rotate = { axis = [0, -1, 0], angle = 30 }
)";

class RunCommand : public ::testing::Test {
 protected:
  RunCommand() { write_text(scene_, scene_text); }

  /// Runs into the folder `out` of the test's own folder. @return exit status
  int run(const std::string& out, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"run", scene_.string(), "--out", (folder_ / out).string(),
                                          "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return command(std::move(arguments));
  }

  int command(std::vector<std::string> arguments) {
    std::ostringstream out;
    std::ostringstream err;
    const int status = run_command_line(std::move(arguments), out, err);
    printed_ = out.str();
    faults_ = err.str();
    return status;
  }

  [[nodiscard]] std::string text(const std::string& path) const { return read_text(folder_ / path); }

  [[nodiscard]] std::vector<std::string> lines(const std::string& path) const {
    std::istringstream input(text(path));
    std::vector<std::string> result;
    for (std::string line; std::getline(input, line);) result.push_back(line);
    return result;
  }

  /// A column of numbers of a table without quoted fields. @param name the column has
  [[nodiscard]] std::vector<double> column(const std::string& path, const std::string& name) const {
    const auto fields_of = [](const std::string& line) {
      std::vector<std::string> fields;
      std::istringstream input(line);
      for (std::string field; std::getline(input, field, ',');) fields.push_back(field);
      return fields;
    };
    const std::vector<std::string> table = lines(path);
    const std::vector<std::string> names = fields_of(table.at(0));
    const auto place = std::find(names.begin(), names.end(), name) - names.begin();
    std::vector<double> values;
    for (std::size_t k = 1; k < table.size(); ++k)
      values.push_back(std::stod(fields_of(table[k]).at(static_cast<std::size_t>(place))));
    return values;
  }

  /// Names of the files in a folder, sorted.
  [[nodiscard]] std::vector<std::string> files(const std::string& path) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / path)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  /// Everything but what is measured in wall time.
  void expect_same_results(const std::string& a, const std::string& b) const {
    for (const char* file : {"history.csv", "contacts.csv", "blocks.pvd", "contacts.pvd"}) {
      EXPECT_EQ(text(a + "/" + file), text(b + "/" + file)) << file;
    }
    const std::string frames_a = a + "/frames/", frames_b = b + "/frames/";
    ASSERT_EQ(files(frames_a), files(frames_b));
    for (const std::string& frame : files(frames_a)) {
      EXPECT_TRUE(text(frames_a + frame) == text(frames_b + frame)) << frame;
    }
  }

  TemporaryFolder folder_;
  std::filesystem::path scene_ = folder_ / "s.toml";
  std::string printed_;
  std::string faults_;
};

}  // namespace ashlar

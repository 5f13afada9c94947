// The states that answers of limit analysis and thrust speak of: forces in balance, as steps of the run.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::shown_states_test {
namespace {

class ShownStates : public RunCommand {
 protected:
  void scene(const std::string& text) { write_text(scene_, text); }
  [[nodiscard]] nlohmann::json summary() const { return nlohmann::json::parse(text("out/summary.json")); }

  /// Sum of the forces on each block in the rows of a step of contacts.csv, N.
  [[nodiscard]] std::map<std::string, Vector3> forces(int step) const {
    std::map<std::string, Vector3> sums;
    const std::vector<std::string> table = lines("out/contacts.csv");
    for (std::size_t k = 1; k < table.size(); ++k) {
      const std::vector<std::string> row = split(table[k]);
      if (std::stoi(row[0]) != step) continue;
      Vector3 force;
      for (std::size_t axis = 0; axis < 3; ++axis)
        force[static_cast<Eigen::Index>(axis)] = std::stod(row[8 + axis]) + std::stod(row[11 + axis]);
      sums.try_emplace(row[2], Vector3::Zero()).first->second += force;
      sums.try_emplace(row[3], Vector3::Zero()).first->second -= force;
    }
    return sums;
  }

 private:
  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream input(line);
    for (std::string field; std::getline(input, field, ',');) fields.push_back(field);
    return fields;
  }
};

std::string cube(const std::string& analysis) {
  return "analysis = " + analysis + R"(
contact = { friction_angle = 60 }
material = [{ name = "stone", density = 1000, young_modulus = 1e10, poisson_ratio = 0.2 }]
measure = [{ name = "joint", pair = ["cube", "floor"] }]
[[block]]
name = "floor"
fixed = true
box = { min = [-5, -5, -1], max = [5, 5, 0] }
[[block]]
name = "cube"
material = "stone"
order = 0
box = { min = [0, 0, 0], max = [1, 1, 1] }
load = [{ force = [1000, 0, 0], point = [0, 0.5, 1] }]
)";
}

// A push at the top of a cube of 9810 N tips it at 4905 N: weight at half the width, push at the height. At the limit the
// ground bears both, at the edge.
TEST_F(ShownStates, ACapacityShowsItsForcesAndItsMotion) {
  scene(cube(R"({ type = "capacity", capacity = { tolerance = 0.001 } })"));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const nlohmann::json states = summary().at("states");
  ASSERT_EQ(states.size(), 2U);
  EXPECT_EQ(states[0].at("step"), 1);
  const double lower = summary().at("load_factor").at("lower");
  EXPECT_NEAR(lower, 4.905, 0.006);
  for (const int step : {1, 2}) {
    const Vector3 on_cube = forces(step).at("cube");
    EXPECT_NEAR(on_cube.x(), -1000.0 * lower, 0.05) << step;
    EXPECT_NEAR(on_cube.z(), 9810.0, 0.05) << step;
  }
  const std::vector<double> normal = column("out/history.csv", "joint.normal_force");
  ASSERT_EQ(normal.size(), 3U);
  EXPECT_NEAR(normal[1], 9810.0, 0.05);
  EXPECT_NEAR(column("out/history.csv", "joint.shear_force")[1], 1000.0 * lower, 0.05);
}

// With nothing to find up to the largest factor there is no motion, and the state is that of this factor.
TEST_F(ShownStates, WhatStandsHasNoMotionToShow) {
  scene(cube(R"({ type = "capacity", capacity = { upper = 2 } })"));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  ASSERT_EQ(summary().at("states").size(), 1U);
  EXPECT_NEAR(forces(1).at("cube").x(), -2000.0, 0.02);
}

// A cube that moves at all factors has no state at rest.
TEST_F(ShownStates, WhatDoesNotStandHasNoForces) {
  scene(
      cube(R"({ type = "factor-of-safety", gravity = [9.81, 0, -1], safety = { lower = 0.9, upper = 2 } })"));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  ASSERT_EQ(summary().at("states").size(), 1U);
  EXPECT_TRUE(forces(1).empty());
}

std::string arch(const std::string& analysis) {
  return "analysis = " + analysis + R"toml(
contact = { friction_angle = 40 }
material = [{ name = "stone", density = 2000, young_modulus = 1e10, poisson_ratio = 0.2 }]
masonry = [{ name = "a", kind = "arch", material = "stone", order = 0, center = [0, 0, 0], radius = 2, thickness = 0.6, width = 1, from = 30, to = 150, voussoirs = 7 }]
[[block]]
name = "left"
fixed = true
hull.points = [
  ["= -1.7*cos(30*deg)", -0.5, "= 1.7*sin(30*deg)"], ["= -2.3*cos(30*deg)", -0.5, "= 2.3*sin(30*deg)"], [-3, -0.5, 0],
  ["= -1.7*cos(30*deg)", 0.5, "= 1.7*sin(30*deg)"], ["= -2.3*cos(30*deg)", 0.5, "= 2.3*sin(30*deg)"], [-3, 0.5, 0]]
[[block]]
name = "right"
fixed = true
hull.points = [
  ["= 1.7*cos(30*deg)", -0.5, "= 1.7*sin(30*deg)"], ["= 2.3*cos(30*deg)", -0.5, "= 2.3*sin(30*deg)"], [3, -0.5, 0],
  ["= 1.7*cos(30*deg)", 0.5, "= 1.7*sin(30*deg)"], ["= 2.3*cos(30*deg)", 0.5, "= 2.3*sin(30*deg)"], [3, 0.5, 0]]
)toml";
}

// Forces on each voussoir balance its weight in every state, and those on a support have its thrust.
TEST_F(ShownStates, ThrustAndMovementsBalanceEachVoussoir) {
  scene(arch(R"({ type = "thrust", movement = { supports = ["right"], limit = 0.02 } })"));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const nlohmann::json states = summary().at("states");
  // Least and largest of two supports, then both ways of one.
  ASSERT_EQ(states.size(), 6U);
  const double weight = 2000 * 9.81 * (120.0 / 360.0) * 3.14159265358979 * (2.3 * 2.3 - 1.7 * 1.7) / 7.0;
  for (int step = 1; step <= 6; ++step) {
    for (const auto& [name, force] : forces(step)) {
      if (name == "left" || name == "right") continue;
      EXPECT_NEAR(force.x(), 0.0, 1e-3 * weight) << step << name;
      EXPECT_NEAR(force.z(), weight, 0.02 * weight) << step << name << ": voussoirs are polyhedra";
    }
  }
  const nlohmann::json thrust = summary().at("thrust").at(1);
  ASSERT_EQ(thrust.at("support"), "right");
  EXPECT_NEAR(forces(3).at("right").x(), thrust.at("least"), 1e-3 * weight);
  EXPECT_NEAR(forces(4).at("right").x(), thrust.at("most"), 1e-3 * weight);
  EXPECT_NE(states[4].at("name").get<std::string>().find("right moved"), std::string::npos);
}

}  // namespace
}  // namespace ashlar::shown_states_test

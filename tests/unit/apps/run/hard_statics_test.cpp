// Static analyses that needed many iterations: blocks that start to move slowly, and friction that alternates.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::hard_statics_test {
namespace {

class HardStatics : public RunCommand {
 protected:
  nlohmann::json summary_of(const std::string& text_of_scene) {
    write_text(scene_, text_of_scene);
    EXPECT_EQ(run("out", {"--force"}), exit_status::done) << faults_;
    return nlohmann::json::parse(text("out/summary.json"));
  }
};

// A wall under a horizontal share alpha of its weight turns over at alpha = (t / 2) / z = 0.45 / 2.25. Springs make it
// lean before, so that it falls a little earlier, never later.
TEST_F(HardStatics, AWallThatTurnsOverSlowlyIsToldSoon) {
  const std::string wall = R"(
analysis = { type = "static", gravity = [0, "= 9.81*alpha", -9.81] }
contact = { friction_angle = 31 }
material = [{ name = "stone", density = 2100, young_modulus = 2e9, poisson_ratio = 0.2 }]
block = [{ name = "base", fixed = true, box = { min = [-1,-1,-0.5], max = [5,2,0] } }]
masonry = [{ name = "wall", kind = "wall", material = "stone", order = 0, length = 4, height = 4.5, thickness = 0.9, brick = [2,0.9,1.5] }]
)";
  EXPECT_EQ(summary_of("parameters = { alpha = 0.198 }" + wall).at("status"), "equilibrium");
  const nlohmann::json moving = summary_of("parameters = { alpha = 0.2002 }" + wall);
  EXPECT_EQ(moving.at("status"), "moving");
  EXPECT_LE(moving.at("steps"), 16);
}

// The stress of pure bending balances the moments at the ends of a beam that is held there: it stays as it is, and the forces
// on its unknowns are rounding. The beam beside it bends until its stress is gone, by the curvature k: its ends rise by
// k x^2 / 2.
TEST_F(HardStatics, AHeldBeamInBalanceDoesNotKeepAnotherFromConverging) {
  for (const int order : {2, 3}) {
    const nlohmann::json summary = summary_of(fmt::format(R"(
analysis = {{ type = "static", gravity = [0, 0, 0] }}
contact = {{ friction_angle = 30 }}
initial_stress = {{ stress = ["= -3e9*1e-4*z", 0, 0, 0, 0, 0] }}
material = [{{ name = "rock", density = 2000, young_modulus = 3e9, poisson_ratio = 0.25 }}]
measure = [{{ name = "end", block = "free", point = [2, 3, 0] }}]
[[block]]
name = "held"
material = "rock"
order = {0}
box = {{ min = [-2, -0.5, -0.4], max = [2, 0.5, 0.4] }}
fix = [
  {{ plane = {{ point = [-2, 0, 0], normal = [1, 0, 0] }} }},
  {{ plane = {{ point = [2, 0, 0], normal = [1, 0, 0] }} }},
]
[[block]]
name = "free"
material = "rock"
order = {0}
box = {{ min = [-2, 2.5, -0.4], max = [2, 3.5, 0.4] }}
fix = [
  {{ point = [0, 3, 0] }},
  {{ point = [2, 3, 0], components = ["y"] }},
  {{ point = [0, 3, 0.4], components = ["x", "y"] }},
]
)",
                                                          order));
    EXPECT_EQ(summary.at("status"), "equilibrium") << order;
    EXPECT_LE(summary.at("steps"), 30) << order;
    EXPECT_NEAR(std::abs(column("out/history.csv", "end.uz").back()), 0.5 * 1e-4 * 4.0, 1e-7) << order;
  }
}

/// A cube that falls beside a wall, and a plate on a slope with a = g (sin 30 - cos 30 tan phi), 0.5 or 5 % of g.
TEST_F(HardStatics, ThoseThatYieldAreToldApartFromThoseThatMove) {
  const auto message_of = [&](double acceleration) {
    const double degree = std::acos(-1.0) / 180.0;
    const double tangent = std::tan(30 * degree) - acceleration / (9.81 * std::cos(30 * degree));
    return summary_of(fmt::format("analysis = {{ type = \"static\" }}\ncontact = {{ friction_angle = {} }}\n",
                                  std::atan(tangent) / degree) +
                      rock_text + plate_text + R"([[block]]
name = "falling"
material = "rock"
box = { min = [20, 0, 0], max = [21, 1, 1] }
[[block]]
name = "wall"
fixed = true
box = { min = [21, 0, 0], max = [22, 1, 1] }
)")
        .at("message")
        .get<std::string>();
  };
  const std::string apart = message_of(0.05), both = message_of(0.5);
  EXPECT_EQ(apart.find("no equilibrium: block falling moves, acceleration ["), 0U) << apart;
  EXPECT_NE(apart.find("; 1 yields at less than 1 % of it"), std::string::npos) << apart;
  EXPECT_EQ(both.find("no equilibrium: 2 of 2 blocks move: "), 0U) << both;
  EXPECT_EQ(both.find("yield"), std::string::npos) << both;
}

// Solid walls of random sizes turn over at a share t / h of their weight, wherever their joints are.
TEST_F(HardStatics, RandomWallsTurnOverAtTheirLimit) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  for (int n = 0; n < 8; ++n) {
    const int courses = 2 + n % 4, bricks = 2 + n % 3;
    const double t = between(0.15, 1.0), brick = between(0.5, 2.0), course = t * between(0.8, 1.5);
    const auto wall = [&](double share) {
      return fmt::format(R"(
analysis = {{ type = "static", gravity = [0, {}, -9.81] }}
contact = {{ friction_angle = 60 }}
material = [{{ name = "stone", density = 2100, young_modulus = 2e10, poisson_ratio = 0.2 }}]
block = [{{ name = "base", fixed = true, box = {{ min = [-1, -3, -0.5], max = [20, 4, 0] }} }}]
masonry = [{{ name = "wall", kind = "wall", material = "stone", order = 0, length = {}, height = {}, thickness = {}, brick = [{}, {}, {}] }}]
)",
                         9.81 * share * t / (courses * course), bricks * brick, courses * course, t, brick, t,
                         course);
    };
    EXPECT_EQ(summary_of(wall(0.985)).at("status"), "equilibrium") << wall(0.985);
    EXPECT_EQ(summary_of(wall(1.015)).at("status"), "moving") << wall(1.015);
  }
}

// Excavation in stressed ground, joints of given stiffness: friction of two blocks alternates, by 3e-8 of their size.
TEST_F(HardStatics, ATunnelWithJointsOfGivenStiffnessStands) {
  const nlohmann::json summary =
      summary_of(R"toml(title = "Tunnel at 90 m depth, three joint sets, two rounds"
[parameters]
weight = "= 2650*9.81"
top = 14
surface = 90
[analysis]
type = "static"
[contact]
friction_angle = 28
normal_stiffness = 1e10
shear_stiffness = 5e9
[[material]]
name = "rock"
density = 2650
young_modulus = 1.5e10
poisson_ratio = 0.25
[initial_stress]
k0 = 0.7
surface = "= surface"
[[block]]
name = "rock"
material = "rock"
box = { min = [-8, 0, 0], max = [8, 4, "= top"] }
fix = [
 { plane = { point = [0,0,0], normal = [0,0,1] } },
 { plane = { point = [-8,0,0], normal = [1,0,0] }, components = ["x"] },
 { plane = { point = [8,0,0], normal = [1,0,0] }, components = ["x"] },
 { plane = { point = [0,0,0], normal = [0,1,0] }, components = ["y"] },
 { plane = { point = [0,4,0], normal = [0,1,0] }, components = ["y"] },
]
load = [{ plane = { point = [0,0,"= top"], normal = [0,0,1] }, traction = [0,0,"= -weight*(surface-top)"] }]
[[cut]]
name = "round1"
blocks = ["rock"]
solid.hull.points = [[-2.5,0,3],[2.5,0,3],[2.5,0,6],[-2.5,0,6],[1.5,0,7.2],[-1.5,0,7.2],[-2.5,2,3],[2.5,2,3],[2.5,2,6],[-2.5,2,6],[1.5,2,7.2],[-1.5,2,7.2]]
[[cut]]
name = "round2"
blocks = ["rock"]
solid.hull.points = [[-2.5,2,3],[2.5,2,3],[2.5,2,6],[-2.5,2,6],[1.5,2,7.2],[-1.5,2,7.2],[-2.5,4,3],[2.5,4,3],[2.5,4,6],[-2.5,4,6],[1.5,4,7.2],[-1.5,4,7.2]]
[[cut]]
name = "east"
blocks = ["rock"]
dip = 58
dip_direction = 90
point = [1.9, 0, 7.2]
spacing = 3.2
[[cut]]
name = "west"
blocks = ["rock"]
dip = 62
dip_direction = 270
point = [-1.9, 0, 7.2]
spacing = 3.2
[[cut]]
name = "across"
blocks = ["rock"]
dip = 85
dip_direction = 5
point = [0, 2.2, 7.2]
min_volume = 0.01
[[stage]]
name = "in situ"
[[stage]]
name = "round 1"
remove = ["rock.round1.inside.*"]
reset_displacement = true
[[stage]]
name = "round 2"
remove = ["rock.round2.inside.*"]
)toml");
  EXPECT_EQ(summary.at("status"), "equilibrium");
  ASSERT_EQ(summary.at("stages").size(), 3U);
  for (const nlohmann::json& stage : summary.at("stages")) EXPECT_LE(stage.at("steps"), 100) << stage;
}

}  // namespace
}  // namespace ashlar::hard_statics_test

// Vaults from drawings: a surface drawn as one is one surface, and overlaps by rounding are accepted.
#include <gmock/gmock.h>

#include <random>

#include "apps/results/text/json_text.hpp"
#include "support/drawn_vaults.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::drawn_vaults_test {
namespace {

using test_support::DrawnStone;
using ::testing::HasSubstr;
using ::testing::Not;

/// Corners of drawings are rounded to 0.1 mm: each moves by sqrt(3)/2 of that at most, and so does the surface
/// between corners, so that two surfaces that were one are in each other by 1.74e-4 m at most.
constexpr int decimals = 4;
constexpr const char* accepted = "contact.allowed_overlap=2e-4";

class DrawnVault : public RunCommand {
 protected:
  void draw(const std::vector<DrawnStone>& stones, const std::string& more = "") {
    std::mt19937 random(5);
    write_text(folder_ / "vault.obj", test_support::drawing_of(stones, decimals, random));
    write_text(scene_, R"(analysis = { type = "static" }
contact = { friction_angle = 35 }
material = [{ name = "stone", density = 2400, young_modulus = 1e10, poisson_ratio = 0.2 }]
assign = [{ blocks = ["v.base*"], fixed = true }]
[[block]]
name = "v"
material = "stone"
mesh = { file = "vault.obj", split = "groups" }
)" + more);
  }
  int check(std::vector<std::string> sets = {}) {
    std::vector<std::string> arguments = {"check", scene_.string()};
    for (const std::string& set : sets) arguments.insert(arguments.end(), {"--set", set});
    return command(std::move(arguments));
  }
};

TEST_F(DrawnVault, ADomeWhoseStonesShareTheirPolygonsIsAcceptedAsItIs) {
  draw(test_support::drawn_dome(6, 15));
  EXPECT_EQ(check(), 0) << faults_;
  EXPECT_THAT(faults_, Not(HasSubstr("overlap")));
}

// Displacements of a few hundredths of a millimetre: the stones stay where they were drawn.
TEST_F(DrawnVault, ADomeOf90StonesStands) {
  draw(test_support::drawn_dome(6, 15));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const auto summary = parse_json(text("out/summary.json"));
  EXPECT_EQ(summary["status"], "equilibrium");
  EXPECT_LT(summary["largest_displacement"]["value"], 1e-4);
}

TEST_F(DrawnVault, ACrossVaultOf184StonesNeedsAnAllowedOverlap) {
  const auto stones = test_support::drawn_cross_vault({4, 4, 4, 4, 3, 2, 2});
  ASSERT_EQ(stones.size(), 184U);
  draw(stones);
  EXPECT_EQ(check(), 2);
  EXPECT_THAT(faults_, HasSubstr("contact.allowed_overlap accepts more"));
  EXPECT_EQ(check({accepted}), 0) << faults_;
  EXPECT_THAT(faults_, HasSubstr("pairs of blocks are placed in each other"));
}

TEST_F(DrawnVault, ABarrelOf400StonesNeedsAnAllowedOverlap) {
  draw(test_support::drawn_barrel(20, 20));
  EXPECT_EQ(check(), 2);
  EXPECT_EQ(check({accepted}), 0) << faults_;
}

// Two stones with the same six corners at their joint, not coplanar, listed from two sides.
TEST_F(DrawnVault, StonesOnAWarpedBedTouch) {
  const auto stone = [](double below, double above) {
    DrawnStone drawn;
    const std::array<std::array<double, 2>, 6> outline = {
        {{0, 0}, {0.45, 0.001}, {1, 0}, {1, 1}, {0.55, 0.999}, {0, 1}}};
    const std::array<double, 6> warp = {0, 0.001, 0, 0.002, 0, 0.001};
    for (const double height : {below, above})
      for (std::size_t k = 0; k < 6; ++k)
        drawn.corners.emplace_back(outline[k][0], outline[k][1], height + (height == 0.5 ? warp[k] : 0.0));
    drawn.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
    for (int k = 0; k < 6; ++k) drawn.faces.push_back({k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k});
    drawn.support = below == 0.0;
    return drawn;
  };
  draw({stone(0.0, 0.5), stone(0.5, 1.0)});
  EXPECT_EQ(check(), 0) << faults_;
  // The upper stone on multipliers of a joint with friction: it stays.
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const auto summary = parse_json(text("out/summary.json"));
  EXPECT_EQ(summary["status"], "equilibrium");
  EXPECT_LT(summary["largest_displacement"]["value"], 1e-5);
}

// A stone of 1 m and 2400 kg in a floor by 0.1 mm, on springs of 1e9 Pa/m.
constexpr const char* sunk_stone = R"([analysis]
type = "static"
gravity = [0, 0, -10]
[contact]
friction_angle = 35
normal_stiffness = 1e9
allowed_overlap = 2e-4
[[material]]
name = "stone"
density = 2400
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "floor"
fixed = true
box = { min = [-1, -1, -1], max = [2, 2, 0] }
[[block]]
name = "stone"
material = "stone"
order = 0
box = { min = [0, 0, -1e-4], max = [1, 1, 0.9999] }
)";

TEST_F(DrawnVault, AnAllowedOverlapIsListedAndWithoutForce) {
  write_text(scene_, sunk_stone);
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  EXPECT_THAT(
      faults_,
      HasSubstr(
          "s.toml:7:19: warning: 1 pair of blocks is placed in each other, by 0.0001 m at the deepest"));
  const auto summary = parse_json(text("out/summary.json"));
  ASSERT_EQ(summary["known_overlaps"].size(), 1U);
  EXPECT_EQ(summary["known_overlaps"][0]["blocks"], (nlohmann::ordered_json{"floor", "stone"}));
  EXPECT_NEAR(summary["known_overlaps"][0]["depth"], 1e-4, 1e-15);
  EXPECT_EQ(summary["known_overlaps"][0]["exact"], true);
  // 24 kN on 1e9 N/m.
  EXPECT_NEAR(summary["largest_displacement"]["value"], 2.4e-5, 1e-9);
  EXPECT_NEAR(summary["penetration_max"], 2.4e-5, 1e-9);
}

// A block that a later stage adds starts without force where it was placed: the lower stone has gone down by then.
TEST_F(DrawnVault, AStageMayAddWhatOverlaps) {
  write_text(scene_, std::string(sunk_stone) + R"([[block]]
name = "added"
material = "stone"
order = 0
box = { min = [0, 0, 0.9998], max = [1, 1, 1.9998] }
[[measure]]
name = "lower"
block = "stone"
point = [0, 0, 0]
[[measure]]
name = "upper"
block = "added"
point = [0, 0, 1]
[[stage]]
name = "one"
[[stage]]
name = "two"
add = ["added"]
[[stage]]
name = "rest"
)");
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  EXPECT_THAT(faults_, HasSubstr("2 pairs of blocks are placed in each other"));
  // 48 kN on 1e9 N/m, and 24 kN on as much above.
  EXPECT_NEAR(column("out/history.csv", "lower.uz").back(), -4.8e-5, 1e-9);
  EXPECT_NEAR(column("out/history.csv", "upper.uz").back(), -7.2e-5, 1e-9);
}

// A vault that is bonded, with corners in the faces of others: 20 stones in equilibrium where they were drawn.
TEST_F(DrawnVault, StandsWithAnAllowedOverlap) {
  draw(test_support::drawn_barrel(5, 4));
  ASSERT_EQ(run("out", {"--set", accepted}), exit_status::done) << faults_;
  const auto summary = parse_json(text("out/summary.json"));
  EXPECT_EQ(summary["status"], "equilibrium");
  EXPECT_GT(summary["known_overlaps"].size(), 10U);
  EXPECT_LT(summary["largest_displacement"]["value"], 1e-4);
}

}  // namespace
}  // namespace ashlar::drawn_vaults_test

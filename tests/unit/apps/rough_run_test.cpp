// `ashlar run` of scenes with rough joints: limit analysis and statics give the same factors.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::rough_run_test {
namespace {

class RoughRun : public RunCommand {
 protected:
  /// The bracket of the factor of safety.
  std::array<double, 2> factor_of(const std::string& scene, const std::string& out) {
    write_text(scene_, scene);
    EXPECT_EQ(command({"run", scene_.string(), "--out", (folder_ / out).string()}), 0) << faults_;
    const nlohmann::json factor = nlohmann::json::parse(text(out + "/summary.json")).at("factor_of_safety");
    return {factor.at("lower").get<double>(), factor.at("upper").get<double>()};
  }
};

/// A rigid block on a plane, with half of another one on it.
struct RoughSlope {
  double length, width, height;  // m
  double incline;                // degrees
  double jrc, jcs, worn;         // degrees, Pa, degrees
  double density;                // kg/m^3
  std::string closure = {};      // lines of [contact]
};

std::string text_of(const RoughSlope& of, const std::string& method) {
  const double turn = of.incline * std::numbers::pi / 180.0;
  std::ostringstream text;
  text << "[analysis]\ntype = \"factor-of-safety\"\nmethod = \"" << method
       << "\"\nsafety = { tolerance = 2e-3 }\ngravity = [" << 9.81 * std::sin(turn) << ", 0, "
       << -9.81 * std::cos(turn) << "]\n[contact]\nfriction_angle = " << of.worn
       << "\nroughness = { jrc = " << of.jrc << ", jcs = " << of.jcs << " }\n"
       << of.closure << "[[material]]\nname = \"rock\"\ndensity = " << of.density
       << "\nyoung_modulus = 5e10\npoisson_ratio = 0.2\n"
       << "[[block]]\nname = \"ground\"\nfixed = true\nbox = { min = [-9, -9, -1], max = [9, 9, 0] }\n"
       << "[[block]]\nname = \"lower\"\nmaterial = \"rock\"\norder = 0\nbox = { min = [" << -0.5 * of.length
       << ", 0, 0], max = [" << 0.5 * of.length << ", " << of.width << ", " << of.height << "] }\n"
       << "[[block]]\nname = \"upper\"\nmaterial = \"rock\"\norder = 0\nbox = { min = [" << -0.4 * of.length
       << ", 0, " << of.height << "], max = [" << 0.25 * of.length << ", " << 0.9 * of.width << ", "
       << 1.6 * of.height << "] }\n";
  return text.str();
}

RoughSlope random_slope(std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(random() >> 11U);
  };
  const double length = between(0.5, 3.0);
  return {length,
          between(0.3, 2.0),
          between(0.1, 0.4) * length,
          between(15.0, 40.0),
          between(2.0, 18.0),
          std::pow(10.0, between(7.0, 8.3)),
          between(20.0, 33.0),
          2500.0 * std::pow(10.0, between(0.0, 2.0))};
}

TEST_F(RoughRun, StaticAnalysesAgreeWithLimitAnalysis) {
  std::mt19937_64 random(20261130);
  for (int k = 0; k < 8; ++k) {
    const RoughSlope slope = random_slope(random);
    const auto limit = factor_of(text_of(slope, "limit"), "limit" + std::to_string(k));
    const auto statics = factor_of(text_of(slope, "elastic"), "statics" + std::to_string(k));
    EXPECT_LE(limit[0], 1.01 * statics[1]) << k;
    EXPECT_GE(limit[1], 0.98 * statics[0]) << k;
  }
}

// The closure of a joint changes how far blocks sink, not what holds them. Its springs are in statics alone.
TEST_F(RoughRun, StaticAnalysesWithClosureAgreeWithLimitAnalysis) {
  std::mt19937_64 random(20261201);
  for (int k = 0; k < 4; ++k) {
    RoughSlope slope = random_slope(random);
    const auto limit = factor_of(text_of(slope, "limit"), "limit" + std::to_string(k));
    // Some 10 kPa close the joint by half of its largest closure, and 1 MPa nearly wholly.
    slope.closure = "normal_stiffness = 1e9\nmaximum_closure = 1e-5\n";
    const auto statics = factor_of(text_of(slope, "elastic"), "statics" + std::to_string(k));
    EXPECT_LE(limit[0], 1.01 * statics[1]) << k;
    EXPECT_GE(limit[1], 0.98 * statics[0]) << k;
  }
}

}  // namespace
}  // namespace ashlar::rough_run_test

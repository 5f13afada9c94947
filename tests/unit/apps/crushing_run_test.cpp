// `ashlar run` of scenes whose joints crush, or need strength.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>

#include "geometry/triangle_mesh.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::crushing_run_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double g = 9.81;

/// A pier of 0.5 m x 0.4 m x 2 m and 800 kg on the ground, pushed along x at its top.
std::string pushed_pier(const std::string& contact) {
  return std::string("[analysis]\ntype = \"capacity\"\n") +
         "capacity = { lower = 0.001, upper = 100, tolerance = 0.001 }\n[contact]\nfriction_angle = 40\n" +
         contact + "\n" + rock_text + R"([[block]]
name = "ground"
fixed = true
box = { min = [-1, -1, -1], max = [2, 2, 0] }
[[block]]
name = "pier"
material = "rock"
box = { min = [0, 0, 0], max = [0.5, 0.4, 2] }
[[block.load]]
point = [0, 0.2, 2]
force = [1000, 0, 0]
)";
}

class CrushingRun : public RunCommand {
 protected:
  nlohmann::json summary(const std::string& out) {
    return nlohmann::json::parse(text(out + "/summary.json"));
  }
  int run_of(const std::string& scene, const std::string& out) {
    write_text(scene_, scene);
    return command({"run", scene_.string(), "--out", (folder_ / out).string()});
  }
};

TEST_F(CrushingRun, ALoadFactorHasTheLeverArmOfTheStressBlock) {
  // V h = W (b - w)/2, w = W/(f t) = 0.1 m.
  const double weight = 800.0 * g, strength = weight / (0.1 * 0.4);
  ASSERT_EQ(run_of(pushed_pier("compressive_strength = " + std::to_string(strength)), "out"), 0) << faults_;
  const nlohmann::json found = summary("out").at("load_factor");
  const double reference = weight * 0.2 / (2.0 * 1000.0);
  EXPECT_LT(found.at("lower").get<double>(), reference * 1.0005);
  EXPECT_GT(found.at("upper").get<double>(), reference * 0.9995);
  EXPECT_LT(found.at("gap").get<double>(), 1.001e-3);
  EXPECT_TRUE(found.at("least_strength").is_null());
}

// A joint without its lost strength still presses: 1 Pa of cohesion or tension, or less friction after a failure, changes nothing.
TEST_F(CrushingRun, StrengthThatIsLostLeavesPressureAndCrushing) {
  const double weight = 800.0 * g, reference = weight * 0.2 / (2.0 * 1000.0);
  const std::string crushing =
      "compressive_strength = " + std::to_string(weight / (0.1 * 0.4)) + "\nfriction_angle_residual = ";
  for (const std::string lost : {"40\ncohesion = 1", "40\ntensile_strength = 1", "39"}) {
    write_text(scene_, pushed_pier(crushing + lost));
    ASSERT_EQ(command({"run", scene_.string(), "--out", (folder_ / "out").string(), "--force", "--set",
                       "analysis.method=limit"}),
              0)
        << faults_;
    const nlohmann::json found = summary("out").at("load_factor");
    ASSERT_TRUE(found.at("lower").is_number()) << lost;
    EXPECT_NEAR(found.at("lower").get<double>(), reference, 2e-3 * reference) << lost;
    EXPECT_LT(found.at("upper").get<double>(), 1.004 * reference) << lost;
  }
}

TEST_F(CrushingRun, AnAnswerSaysWhatStrengthItNeeds) {
  // w = b - 2 V h/W at the lower end, f = W/(w t), found on the safe side by up to 3 %. Near the limit w is as small as
  // the accuracy of the limit.
  write_text(scene_, pushed_pier(""));
  ASSERT_EQ(command({"run", scene_.string(), "--out", (folder_ / "out").string(), "--set",
                     "analysis.capacity.tolerance=0.03"}),
            0)
      << faults_;
  const nlohmann::json found = summary("out").at("load_factor");
  const double weight = 800.0 * g, force = 1000.0 * found.at("lower").get<double>();
  const double strength = weight / ((0.5 - 2.0 * force * 2.0 / weight) * 0.4);
  const nlohmann::json& least = found.at("least_strength");
  EXPECT_GT(least.at("value").get<double>(), 0.99 * strength);
  EXPECT_LT(least.at("value").get<double>(), 1.05 * strength);
  EXPECT_THAT(least.at("joint"), ElementsAre("ground", "pier"));
  EXPECT_THAT(faults_, HasSubstr("the answer needs a compressive strength of"));
}

// Under 0.8 of its weight per area the cube sinks with 0.2 g: by 0.022 m in 0.15 s.
TEST_F(CrushingRun, DepthOfWhatIsCrushedIsCalledThat) {
  const double strength = 0.8 * 2000.0 * g;
  const std::string scene =
      "[analysis]\nend_time = 0.15\ntime_step = 1e-3\n[contact]\ncompressive_strength = " +
      std::to_string(strength) + "\n" + rock_text + R"([[block]]
name = "ground"
fixed = true
box = { min = [-1, -1, -1], max = [2, 2, 0] }
[[block]]
name = "cube"
material = "rock"
order = 0
box = { min = [0, 0, 0], max = [1, 1, 1] }
)";
  ASSERT_EQ(run_of(scene, "out"), 0) << faults_;
  EXPECT_NEAR(summary("out").at("penetration_max").get<double>(), 0.5 * 0.2 * g * 0.15 * 0.15, 5e-4);
  EXPECT_THAT(faults_, HasSubstr("their joint crushes, and what it has crushed counts"));
}

TEST_F(CrushingRun, LoadsThatCrushJointsAreReported) {
  // The weight needs W/(b t) = 39.24 kPa.
  ASSERT_EQ(run_of(pushed_pier("compressive_strength = 30e3"), "out"), 0) << faults_;
  EXPECT_THAT(faults_,
              HasSubstr("joints crush under the loads without a factor: compressive_strength is 0.03 MPa, at "
                        "least 0.039"));
  const nlohmann::json found = summary("out").at("load_factor");
  EXPECT_TRUE(found.at("lower").is_null());
  EXPECT_NEAR(found.at("least_strength").at("value").get<double>(), 39240.0, 0.03 * 39240.0);
}

TEST_F(CrushingRun, BadStrengthsAreRefusedAtTheirPlaces) {
  EXPECT_EQ(run_of(pushed_pier("compressive_strength = 0"), "out"), 2);
  EXPECT_THAT(faults_, HasSubstr(":6:24: error: compressive_strength is out of range (0)"));
  EXPECT_EQ(run_of(pushed_pier("compressive_strength = 1e5\ntensile_strength = 2e5"), "out"), 2);
  EXPECT_THAT(
      faults_,
      HasSubstr(":6:24: error: compressive_strength is below tensile_strength (100000 Pa, 200000 Pa)"));
}

/// The pier with another analysis.
std::string with_analysis(const std::string& analysis, const std::string& contact) {
  const std::string scene = pushed_pier(contact);
  return analysis + scene.substr(scene.find("\n[contact]"));
}

TEST_F(CrushingRun, AnalysesWithoutCrushingRefuseTheKey) {
  for (const char* analysis :
       {"[analysis]\ntype = \"pushover\"\npushover = { direction = [1, 0, 0], limit = 0.1 }",
        "[analysis]\ntype = \"thrust\"\nmovement = { supports = [\"ground\"] }"}) {
    EXPECT_EQ(run_of(with_analysis(analysis, "compressive_strength = 1e6"), "out"), 2) << analysis;
    EXPECT_THAT(faults_, HasSubstr(": error: compressive_strength in a")) << analysis;
  }
}

TEST_F(CrushingRun, SpringsThatCrushHaveNoDilation) {
  for (const char* analysis :
       {"[analysis]\ntype = \"static\"", "[analysis]\nend_time = 1\ntime_step = 0.1"}) {
    EXPECT_EQ(run_of(with_analysis(analysis, "compressive_strength = 1e6\ndilation_angle = 5"), "out"), 2);
    EXPECT_THAT(faults_, HasSubstr("error: dilation_angle beside compressive_strength"));
  }
}

TEST_F(CrushingRun, AStaticAnalysisStandsAndMovesWhereTheStressBlockSays) {
  // V h = W (b - w)/2 with w = W/(f t) = 0.1 m: V = 0.4 W b/h in half of the width.
  const double weight = 800.0 * g, strength = weight / (0.1 * 0.4);
  const double limit = weight * 0.2 / 2.0;
  for (const double share : {0.98, 1.02}) {
    std::string scene =
        with_analysis("[analysis]\ntype = \"static\"",
                      "normal_stiffness = 1e12\ncompressive_strength = " + std::to_string(strength));
    const std::string force = "force = [1000";
    scene.replace(scene.find(force), force.size(), "force = [" + std::to_string(share * limit));
    const std::string out = share < 1.0 ? "stands" : "moves";
    ASSERT_EQ(run_of(scene, out), 0) << faults_;
    EXPECT_EQ(summary(out).at("status"), share < 1.0 ? "equilibrium" : "moving") << share;
  }
}

/// Piers of any shape, strength and order. @param share of the width that crushes under the weight
/// @param lost strength that the joint loses
std::string any_pier(const Vector3& size, double share, int order, const std::string& method,
                     const std::string& lost = "") {
  const double weight = 2000.0 * size.prod() * g;
  std::ostringstream text;
  text << "[analysis]\ntype = \"capacity\"\nmethod = \"" << method
       << "\"\ncapacity = { lower = 0.01, upper = 2, tolerance = 1e-3 }\n[contact]\nfriction_angle = 50\n"
       << "normal_stiffness = 1e12\nshear_stiffness = 5e11\ncompressive_strength = "
       << weight / (share * size[0] * size[1]) << '\n'
       << lost << rock_text << "[[block]]\nname = \"ground\"\nfixed = true\n"
       << "box = { min = [-2, -2, -1], max = [4, 4, 0] }\n[[block]]\nname = \"pier\"\nmaterial = "
          "\"rock\"\norder = "
       << order << "\nbox = { min = [0, 0, 0], max = [" << size[0] << ", " << size[1] << ", " << size[2]
       << "] }\n[[block.load]]\npoint = [0, " << 0.5 * size[1] << ", " << size[2] << "]\nforce = ["
       << 0.5 * weight * size[0] / size[2] << ", 0, 0]\n";
  return text.str();
}

/// Without crushing the factor is 1, with it 1 - share: F h = W (b - w)/2.
TEST_F(CrushingRun, StaticAnalysesAgreeWithLimitAnalysis) {
  std::mt19937_64 random(20261130);
  const auto between = [&](double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(random() >> 11U);
  };
  for (int k = 0; k < 6; ++k) {
    const Vector3 size(between(0.3, 1.0), between(0.2, 1.0), between(1.0, 2.5));
    const double share = between(0.05, 0.4);
    for (const std::string method : {"limit", "elastic"}) {
      const std::string out = method + std::to_string(k);
      ASSERT_EQ(run_of(any_pier(size, share, k % 3, method), out), 0) << faults_;
      EXPECT_NEAR(summary(out).at("load_factor").at("lower").get<double>(), 1.0 - share, 0.01 * (1.0 - share))
          << out << ", size " << size.transpose() << ", share " << share;
    }
    for (const char* lost : {"cohesion = 1\n", "tensile_strength = 1\n", "friction_angle_residual = 49\n"}) {
      const std::string out = "lost" + std::to_string(k) + lost[0];
      ASSERT_EQ(run_of(any_pier(size, share, k % 3, "limit", lost), out), 0) << faults_;
      EXPECT_NEAR(summary(out).at("load_factor").at("lower").get<double>(), 1.0 - share, 0.01 * (1.0 - share))
          << lost << ", size " << size.transpose() << ", share " << share;
    }
  }
}

}  // namespace
}  // namespace ashlar::crushing_run_test

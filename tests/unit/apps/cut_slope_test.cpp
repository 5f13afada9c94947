// A slope between three sets of joints (tests/networks/cut_slope.toml), small, by a static analysis.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "support/simulations.hpp"

namespace ashlar::cut_slope_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::optional<BuiltSimulation> built_slope(std::vector<std::string> changes) {
  changes.emplace_back("analysis.type=\"static\"");
  Diagnostics diagnostics;
  const auto loaded = load_scene(std::filesystem::path(ASHLAR_DATA_DIR) / "../tests/networks/cut_slope.toml",
                                 changes, diagnostics);
  if (!loaded) return std::nullopt;
  return build_simulation(*loaded, 1, diagnostics);
}

std::string friction(const std::string& key, double angle) {
  return key + ".friction_angle=" + std::to_string(angle);
}

class CutSlope : public testing::TestWithParam<double> {};

// Rock on the bedding through the toe begins to slide with a = g (sin 30 - cos 30 tan(phi)), as one. In the first
// iterations inertia resists its weight and it falls; each of the few that follow has another set of sliding joints.
TEST_P(CutSlope, SetsOffAlongItsBedding) {
  const double angle = GetParam();
  auto built = built_slope({"parameters.height=4", "parameters.width=3", friction("joint.0", angle)});
  ASSERT_TRUE(built);
  Simulation& simulation = built->simulation;
  const StaticStatus status = test_support::run_static(simulation, 1.0);
  const double along = 9.81 * (std::sin(30 * degree) - std::cos(30 * degree) * std::tan(angle * degree));
  if (along < 0.0) {
    EXPECT_EQ(status, StaticStatus::equilibrium);
    return;
  }
  ASSERT_EQ(status, StaticStatus::moving);
  const std::vector<MovingBlock> moving = simulation.moving_blocks();
  ASSERT_FALSE(moving.empty());
  const Vector3 expected = along * Vector3(std::cos(30 * degree), 0.0, -std::sin(30 * degree));
  for (const MovingBlock& block : moving)
    EXPECT_LT((block.acceleration - expected).norm(), 0.01 * along) << block.block;
}

// Between steep joints of high friction the bounds of friction do not converge in some iterations. The slope is far from
// its limit: bedding alone would hold it with tan(29) / 0.84 against tan(30).
TEST(SteepJoints, StandsWhereFrictionDoesNotSettleAtOnce) {
  const auto raised = [](double angle) { return std::atan(std::tan(angle * degree) / 0.84) / degree; };
  auto built = built_slope({"parameters.height=6", "parameters.width=6", "parameters.length=16",
                            "contact.augmented=true", friction("contact", raised(40)),
                            friction("joint.0", raised(29))});
  ASSERT_TRUE(built);
  EXPECT_EQ(test_support::run_static(built->simulation, 1.0), StaticStatus::equilibrium);
  EXPECT_GT(built->simulation.counts().open_close_fallbacks, 0U);
}

INSTANTIATE_TEST_SUITE_P(At, CutSlope, testing::Values(20.0, 28.0, 29.5, 32.0));

}  // namespace
}  // namespace ashlar::cut_slope_test

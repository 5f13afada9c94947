// A slope between three sets of joints (tests/networks/cut_slope.toml), small, by a static analysis.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "apps/scene/build_simulation.hpp"
#include "apps/scene/scene_loading.hpp"

namespace ashlar {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

class CutSlope : public testing::TestWithParam<double> {};

// What lies on the bedding through the toe sets off along it with a = g (sin 30 - cos 30 tan(phi)), as one. In the first
// iterations inertia bears its weight and it falls; which joints slide is another set in each of the few that follow.
TEST_P(CutSlope, SetsOffAlongItsBedding) {
  const double friction = GetParam();
  Diagnostics diagnostics;
  const auto loaded = load_scene(std::filesystem::path(ASHLAR_DATA_DIR) / "../tests/networks/cut_slope.toml",
                                 {"analysis.type=\"static\"", "parameters.height=4", "parameters.width=3",
                                  "joint.0.friction_angle=" + std::to_string(friction)},
                                 diagnostics);
  ASSERT_TRUE(loaded);
  auto built = build_simulation(*loaded, 1, diagnostics);
  ASSERT_TRUE(built);
  Simulation& simulation = built->simulation;
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(1.0);
  const double along = 9.81 * (std::sin(30 * degree) - std::cos(30 * degree) * std::tan(friction * degree));
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

INSTANTIATE_TEST_SUITE_P(At, CutSlope, testing::Values(20.0, 28.0, 29.5, 32.0));

}  // namespace
}  // namespace ashlar

// Rock between three tilted sets of joints that begins to slide in all of them.
#include <gtest/gtest.h>

#include <filesystem>

#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "support/simulations.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::sliding_rock_test {
namespace {

class SlidingRock : public RunCommand {};

// The residual of most blocks falls while a few slivers keep all of theirs: that is progress, and Newton needs no fallback.
TEST_F(SlidingRock, NeedsNoFallbackWhereTheWorstBlockImprovesLast) {
  write_text(scene_, R"(
analysis = { end_time = 4e-3, time_step = 1e-3, gravity = [0, 0, -9.81] }
contact = { friction_angle = 25 }
material = [{ name = "rock", density = 2700, young_modulus = 1e10, poisson_ratio = 0.2 }]
cut = [
  { name = "a", blocks = ["rock"], dip = 35, dip_direction = 80, point = [5, 5, 5], spacing = 2.6, min_volume = 1e-2 },
  { name = "b", blocks = ["rock"], dip = 75, dip_direction = 250, point = [5, 5, 5], spacing = 2.6, min_volume = 1e-2 },
  { name = "c", blocks = ["rock"], dip = 80, dip_direction = 165, point = [5, 5, 5], spacing = 2.6, min_volume = 1e-2 },
]
[[block]]
name = "rock"
material = "rock"
order = 0
box = { min = [0, 0, 0], max = [10, 10, 10] }
[[block]]
name = "floor"
fixed = true
box = { min = [-2, -2, -1], max = [12, 12, 0] }
)");
  Diagnostics diagnostics;
  const auto loaded = load_scene(scene_, {}, diagnostics);
  ASSERT_TRUE(loaded);
  auto built = build_simulation(*loaded, 1, diagnostics);
  ASSERT_TRUE(built);
  Simulation& simulation = built->simulation;
  ASSERT_TRUE(test_support::run_until(simulation, 4e-3));
  EXPECT_GT(simulation.report().sliding, simulation.report().locked);
  EXPECT_EQ(simulation.counts().open_close_fallbacks, 0U);
  EXPECT_TRUE(simulation.rejections().empty());
}

}  // namespace
}  // namespace ashlar::sliding_rock_test

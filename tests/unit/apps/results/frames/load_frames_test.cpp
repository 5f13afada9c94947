#include "apps/results/frames/load_frames.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "apps/results/frames/grid_arrays.hpp"
#include "unit/apps/results/ended_run.hpp"

namespace ashlar::test::load_frames_test {
namespace {

using ::testing::ElementsAre;

// A beam clamped at x = 0, on a roller at x = 4 (z held), pressed by 100 Pa on the 4 m^2 of its top, by 7 N at a point, and
// by a load that has not begun.
TEST(LoadFrames, ResultantsAndSupportsAreAtTheirFaces) {
  const EndedRun run(R"(
analysis = { type = "static", gravity = [0, 0, 0], end_time = 1, time_step = 1 }
material = [{ name = "stone", density = 2000, young_modulus = 1e12, poisson_ratio = 0 }]
[[block]]
name = "beam"
material = "stone"
box = { min = [0, 0, 0], max = [4, 1, 1] }
fix = [{ plane = { point = [0, 0, 0], normal = [1, 0, 0] } },
       { plane = { point = [4, 0, 0], normal = [1, 0, 0] }, components = ["z"] }]
load = [{ plane = { point = [0, 0, 1], normal = [0, 0, 1] }, traction = [0, 0, -100] },
        { point = [4, 1, 1], force = [0, 7, 0] },
        { point = [4, 1, 1], force = [0, 9, 0], history = [[5, 0], [6, 1]] }]
)");
  const Scene& scene = run.run().whole();
  const Simulation& simulation = run.run().simulation();
  ASSERT_TRUE(has_loads_or_supports(scene));
  const UnstructuredGrid grid = load_frame(simulation, drawn_actions(scene, simulation.blocks()), 0);
  EXPECT_NO_THROW(validate(grid));
  // Two loads, then two triangles for each supported face.
  EXPECT_THAT(required_values<std::int32_t>(grid.cell_data, "held", 1), ElementsAre(0, 0, 7, 7, 4, 4));
  const auto& force = required_values<double>(grid.cell_data, "force", 3);
  ASSERT_GE(force.size(), 6U);
  EXPECT_NEAR((Vector3(force[0], force[1], force[2]) - Vector3(0, 0, -400)).norm(), 0.0, 1e-10);
  EXPECT_NEAR((Vector3(force[3], force[4], force[5]) - Vector3(0, 7, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((grid.points[0] - Vector3(2, 0.5, 1)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((grid.points[1] - Vector3(4, 1, 1)).norm(), 0.0, 1e-6);
  for (std::size_t k = 2; k < 8; ++k) EXPECT_NEAR(grid.points[k].x(), 0.0, 1e-9);
  for (std::size_t k = 8; k < 14; ++k) EXPECT_NEAR(grid.points[k].x(), 4.0, 1e-6);
}

// A load goes 2 m in a second, in steps of 1 m: after a quarter of it half of it is at each of the first two points.
TEST(LoadFrames, AMovingLoadIsOneArrow) {
  const EndedRun run(R"(
analysis = { end_time = 0.25, time_step = 0.05, gravity = [0, 0, 0] }
material = [{ name = "stone", density = 2000, young_modulus = 1e12, poisson_ratio = 0 }]
load = [{ force = [0, 0, -10], path = [[0, 1, 0.5, 2], [1, 3, 0.5, 2]], spacing = 1 }]
[[block]]
name = "deck"
material = "stone"
box = { min = [0, 0, 0], max = [4, 1, 1] }
fix = [{ plane = { point = [0, 0, 0], normal = [0, 0, 1] } }]
)");
  const Simulation& simulation = run.run().simulation();
  const UnstructuredGrid grid =
      load_frame(simulation, drawn_actions(run.run().whole(), simulation.blocks()), 0);
  const auto& held = required_values<std::int32_t>(grid.cell_data, "held", 1);
  EXPECT_EQ(std::count(held.begin(), held.end(), 0), 1);
  EXPECT_NEAR((grid.points[0] - Vector3(1.5, 0.5, 1)).norm(), 0.0, 1e-6);
  const auto& force = required_values<double>(grid.cell_data, "force", 3);
  EXPECT_NEAR((Vector3(force[0], force[1], force[2]) - Vector3(0, 0, -10)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace ashlar::test::load_frames_test

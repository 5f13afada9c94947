#include "apps/results/tables/group_measure.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "unit/apps/results/ended_run.hpp"

namespace ashlar::test::group_measure_test {
namespace {

using ::testing::HasSubstr;

const std::string head = R"(
analysis = { type = "static", gravity = [0, 0, 0], end_time = 1, time_step = 1 }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
)";

/// A fixed cube, and one beside it that its faces at x = 2 and y = 0 move by a vector within a second.
std::string parted_cubes(const std::string& motion, const std::string& crack) {
  return R"(
analysis = { end_time = 1, time_step = 0.1, gravity = [0, 0, 0] }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
[[block]]
name = "still"
fixed = true
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[block]]
name = "moved"
material = "stone"
box = { min = [1, 0, 0], max = [2, 1, 1] }
[[block.fix]]
plane = { point = [2, 0, 0], normal = [1, 0, 0] }
displacement_history = [[0, 0, 0, 0], [1, )" +
         motion + R"(]]
[[block.fix]]
plane = { point = [2, 0, 0], normal = [0, 1, 0] }
displacement_history = [[0, 0, 0, 0], [1, )" +
         motion + R"(]]
[[measure]]
name = "joint"
crack = )" +
         crack;
}

// Bottom and top of a column are held, the top 0.02 m further in x and 0.05 m in z: u = z / 2 times that, which at heights
// of 0.5 and 1.5 m differs by half of it. The vertical part is no drift.
TEST(GroupMeasure, DriftIsTheHorizontalDisplacementOverTheHeight) {
  const std::string column = head + R"(
[[block]]
name = "column"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 2] }
fix = [{ plane = { point = [0, 0, 0], normal = [0, 0, 1] } },
       { plane = { point = [0, 0, 2], normal = [0, 0, 1] }, displacement_history = [[0, 0, 0, 0], [1, 0.02, 0, 0.05]] }]
[[measure]]
name = "storey"
drift = { blocks = ["column"], heights = [0.5, 1.5] }
)";
  const EndedRun run(column);
  EXPECT_NEAR(run.last("storey.drift"), 0.01, 1e-9);
  EXPECT_NEAR(run.last("storey.drift_x"), 0.01, 1e-9);
  EXPECT_NEAR(run.last("storey.drift_y"), 0.0, 1e-12);
  EXPECT_NEAR(run.last("storey.drift_z"), 0.0, 1e-12);
}

// The upper level cuts two columns of 2000 and 6000 kg, moved by 0.04 and 0.08 m: the mean is 0.07 m. The lower one is
// that of the fixed floor.
TEST(GroupMeasure, BlocksOfALevelCountByTheirMass) {
  const std::string moved = R"(, displacement_history = [[0, 0, 0, 0], [1, )";
  const std::string columns = head + R"(
[[block]]
name = "floor"
fixed = true
box = { min = [-1, -1, -1], max = [9, 4, 0] }
[[block]]
name = "light"
material = "stone"
box = { min = [0, 0, 1], max = [1, 1, 2] }
fix = [{ plane = { point = [0, 0, 1], normal = [0, 0, 1] })" +
                              moved + R"(0, 0.04, 0]] }]
[[block]]
name = "heavy"
material = "stone"
box = { min = [4, 0, 1], max = [5, 3, 2] }
fix = [{ plane = { point = [0, 0, 1], normal = [0, 0, 1] })" +
                              moved + R"(0, 0.08, 0]] }]
[[measure]]
name = "storey"
drift = { inside = { box = { min = [-9, -9, -9], max = [9, 9, 9] } }, heights = [-0.5, 1.5] }
)";
  const EndedRun run(columns);
  EXPECT_NEAR(run.last("storey.drift_y"), 0.07 / 2, 1e-9);
}

// 0.3 m apart and 0.4 m along the joint, far beyond the distance at which contacts are found.
TEST(GroupMeasure, AnOpenedJointHasItsWidth) {
  const EndedRun run(parted_cubes("0.3, 0.4, 0", "{}"));
  EXPECT_NEAR(run.last("joint.largest_opening"), 0.3, 1e-9);
  EXPECT_NEAR(run.last("joint.mean_opening"), 0.3, 1e-9);
  EXPECT_NEAR(run.last("joint.largest_slip"), 0.4, 1e-9);
  EXPECT_NEAR(run.last("joint.open_area"), 1.0, 1e-9);
}

// Two edges of the moved cube are led so that it is sheared: u_x = 0.2 y. Its face opens from 0 to 0.2 m; slip is that
// along the fixed face, 0.
TEST(GroupMeasure, AWedgeIsHalfAsWideInTheMean) {
  const std::string sheared = head + R"(
[[block]]
name = "still"
fixed = true
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[block]]
name = "moved"
material = "stone"
box = { min = [1, 0, 0], max = [2, 1, 1] }
fix = [{ plane = { point = [0, 0, 0], normal = [0, 1, 0] } },
       { plane = { point = [0, 1, 0], normal = [0, 1, 0] }, displacement_history = [[0, 0, 0, 0], [1, 0.2, 0, 0]] }]
[[measure]]
name = "joint"
crack = { joints = ["still"], to = ["moved"] }
)";
  const EndedRun run(sheared);
  EXPECT_NEAR(run.last("joint.largest_opening"), 0.2, 1e-6);
  EXPECT_NEAR(run.last("joint.mean_opening"), 0.1, 1e-6);
  EXPECT_NEAR(run.last("joint.largest_slip"), 0.0, 1e-6);
}

TEST(GroupMeasure, JointsOfOtherBlocksDoNotCount) {
  EXPECT_THAT([] { EndedRun run(parted_cubes("0.3, 0, 0", "{ joints = [\"moved\"], to = [\"moved\"] }")); },
              testing::ThrowsMessage<std::exception>(HasSubstr("no faces of these blocks touch")));
}

TEST(GroupMeasure, FaultsAreTold) {
  EXPECT_THAT(first_fault(parted_cubes("0, 0, 0", "{ joints = [\"bed\"] }")),
              HasSubstr("crack names no joint (\"bed\")"));
  const std::string drift = head + R"(
[[block]]
name = "column"
fixed = true
box = { min = [0, 0, 0], max = [1, 1, 2] }
[[measure]]
name = "storey"
drift = )";
  EXPECT_THAT(first_fault(drift + "{ blocks = [\"column\"], heights = [1, 3] }"),
              HasSubstr("no block of the drift is at the upper level (3 m), its blocks reach from 0 to 2 m"));
  EXPECT_THAT(first_fault(drift + "{ blocks = [\"column\"], heights = [1, 1] }"),
              HasSubstr("heights do not increase (1 and 1); give the lower level first"));
  EXPECT_THAT(first_fault(drift + "{ blocks = [\"columns\"], heights = [0, 1] }"),
              HasSubstr("drift names no block (\"columns\")"));
}

}  // namespace
}  // namespace ashlar::test::group_measure_test

// Fast blocks against thin ones: nothing may pass through in one step.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/sample_solids.hpp"
#include "support/simulations.hpp"

namespace ashlar::passing_test {
namespace {

using test_support::block_of;
using test_support::run_until;
using test_support::same_law;

const Material steel{7800.0, 2e11, 0.3};

Polyhedron turned(const Polyhedron& solid, const Eigen::Quaterniond& turn, const Vector3& by) {
  std::vector<Vector3> points;
  for (const Vector3& point : solid.mesh().points) points.emplace_back(turn * point + by);
  return solid.with_points(std::move(points));
}

/// A solid flies at 50 m/s, half a metre a step, at a fixed plate 0.01 m thick; the whole scene turned.
/// @return height of the flyer's centroid over the plate at the end
double height_after_impact(const Polyhedron& flyer, const Vector3& velocity, const Eigen::Quaterniond& turn,
                           int order = 1) {
  SimulationSettings settings;
  settings.time_step = 1e-2;
  settings.gravity = Vector3::Zero();
  settings.contact_distance = 1e-4;
  std::vector<BlockModel> blocks;
  BlockDefinition plate = block_of(
      "plate", turned(Polyhedron(make_box({-2, -2, -0.01}, {2, 2, 0})), turn, Vector3::Zero()), steel, 1);
  plate.fixed = true;
  blocks.emplace_back(std::move(plate));
  blocks.emplace_back(block_of("flyer", turned(flyer, turn, Vector3::Zero()), steel, order));
  Simulation simulation(std::move(blocks), {{}, {turn * velocity, Vector3::Zero()}},
                        same_law({1e12, 5e11, 0.0, 0.0, 0.0, true}), settings);
  double lowest = 1e9;
  while (!simulation.reached(0.1)) {
    EXPECT_EQ(simulation.step(0.1), StepStatus::accepted);
    const Vector3 centroid = simulation.states()[1].position.transpose() *
                             simulation.blocks()[1].basis().values(simulation.blocks()[1].basis().centroid());
    lowest = std::min(lowest, (turn.inverse() * centroid).z());
  }
  return lowest;
}

const std::vector<Eigen::Quaterniond> turns = {
    Eigen::Quaterniond::Identity(),
    Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Vector3(1, -2, 0.5).normalized()))};

TEST(Passing, ACubeIsStoppedByAThinPlate) {
  for (const auto& turn : turns) {
    for (const double gap : {0.02, 0.17, 0.33, 0.49}) {
      const Polyhedron cube(make_box({-0.5, -0.5, gap}, {0.5, 0.5, gap + 1}));
      EXPECT_GT(height_after_impact(cube, {0, 0, -50}, turn), 0.45) << gap;
    }
  }
}

TEST(Passing, ACubeOnItsCornerOrItsEdgeIsStopped) {
  const Eigen::Quaterniond corner =
      Eigen::Quaterniond::FromTwoVectors(Vector3(1, 1, 1).normalized(), Vector3(0, 0, -1));
  const Eigen::Quaterniond edge(Eigen::AngleAxisd(0.785, Vector3::UnitX()));
  const Polyhedron cube(make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
  for (const auto& turn : turns) {
    EXPECT_GT(height_after_impact(turned(cube, corner, {0.1, 0.2, 1.1}), {0, 0, -50}, turn), 0.4);
    EXPECT_GT(height_after_impact(turned(cube, edge, {0.1, 0.2, 0.9}), {0, 0, -50}, turn), 0.4);
    EXPECT_GT(height_after_impact(turned(cube, corner, {-1.2, 0.2, 1.3}), {40, 0, -40}, turn), 0.4);
  }
}

TEST(Passing, ABlockOfHigherOrderIsStopped) {
  const Polyhedron cube(make_box({-0.5, -0.5, 0.3}, {0.5, 0.5, 1.3}));
  EXPECT_GT(height_after_impact(cube, {0, 0, -50}, turns[1], 2), 0.4);
}

TEST(Passing, CrossedRodsStopEachOther) {
  // Only their ridges meet; no corner comes near a face.
  SimulationSettings settings;
  settings.time_step = 1e-2;
  settings.gravity = Vector3::Zero();
  settings.contact_distance = 1e-4;
  const Eigen::Quaterniond about_y(Eigen::AngleAxisd(0.785, Vector3::UnitY()));
  const Eigen::Quaterniond about_x(Eigen::AngleAxisd(0.785, Vector3::UnitX()));
  std::vector<BlockModel> blocks;
  BlockDefinition below =
      block_of("below", turned(Polyhedron(make_box({-0.05, -2, -0.05}, {0.05, 2, 0.05})), about_y, {0, 0, 0}),
               steel, 1);
  below.fixed = true;
  blocks.emplace_back(std::move(below));
  blocks.emplace_back(block_of(
      "above", turned(Polyhedron(make_box({-2, -0.05, -0.05}, {2, 0.05, 0.05})), about_x, {0, 0, 0.4}), steel,
      1));
  Simulation simulation(std::move(blocks), {{}, {{0, 0, -50}, Vector3::Zero()}},
                        same_law({1e12, 5e11, 0.0, 0.0, 0.0, true}), settings);
  ASSERT_TRUE(run_until(simulation, 0.1));
  EXPECT_GT(
      (simulation.states()[1].position.transpose() * simulation.blocks()[1].basis().values({0, 0, 0.4})).z(),
      0.0);
}

}  // namespace
}  // namespace ashlar::passing_test

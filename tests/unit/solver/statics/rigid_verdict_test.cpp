// Verdicts of limit analysis on static analyses that end without an answer, or jammed.
#include "solver/statics/rigid_verdict.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "sample_limits.hpp"

namespace ashlar::rigid_verdict_test {
namespace {

using test_support::fixed_block;
using test_support::g;
using test_support::joint;
using test_support::leaning_roof;
using test_support::models;
using test_support::rock;
using test_support::run_static;
using test_support::tangent_of;

TEST(RigidVerdict, AStoneThatOnlyWedgingHoldsMoves) {
  // Down its plane of 45 degrees with half of its friction: g (sin 45 - 0.5 cos 45), by half of that in x and -z.
  Simulation simulation = leaning_roof(0.5 * 0.999, 0.0).build();
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  const std::vector<MovingBlock> moving = simulation.moving_blocks();
  ASSERT_EQ(moving.size(), 1U);
  EXPECT_EQ(moving[0].block, 2);
  const double along = g * (1.0 - 0.5 * 0.999) / std::sqrt(2.0);
  EXPECT_NEAR(moving[0].acceleration.norm() / along, 1.0, 1e-6);
}

TEST(RigidVerdict, StressOfTheGroundClampsAWedge) {
  // Faces at 15 degrees from the vertical, friction 35: without the stress it falls, with it springs hold it.
  const double half = 2.0 * tangent_of(15.0);
  const auto prism = [](const std::vector<std::array<double, 2>>& outline) {
    std::vector<Vector3> points;
    for (const auto& [x, z] : outline)
      for (const double y : {0.0, 1.0}) points.emplace_back(x, y, z);
    return Polyhedron(make_convex_hull(points));
  };
  for (const double pressure : {0.0, 4e5}) {
    BlockDefinition wedge = test_support::block_of("wedge", prism({{-half, 0}, {half, 0}, {0, 2}}), rock, 1);
    if (pressure > 0.0)
      wedge.initial_stress = [pressure](const Vector3&) {
        return Eigen::Matrix3d(Vector3(-pressure, 0, 0).asDiagonal());
      };
    SimulationSettings settings;
    settings.gravity = {0, 0, -g};
    JointLaw law = joint(tangent_of(35.0));
    law.normal_stiffness = 1e9;
    law.shear_stiffness = 1e8;
    Simulation simulation(models(wedge, fixed_block(prism({{-half, 0}, {0, 2}, {-4, 2}, {-4, 0}})),
                                 fixed_block(prism({{half, 0}, {0, 2}, {4, 2}, {4, 0}}))),
                          {{}, {}, {}}, test_support::same_law(law), settings);
    simulation.start_stressed();
    EXPECT_EQ(run_static(simulation, 1.0), pressure > 0.0 ? StaticStatus::equilibrium : StaticStatus::moving);
  }
}

/// A rigid plank of 3 m leans on a wall at 50 degrees, on a floor; without width it needs a friction of 0.3496, which
/// its width changes little.
Simulation ladder(double friction) {
  const double turn = 50.0 * 3.14159265358979323846 / 180.0;
  const Vector3 along(std::cos(turn), 0, std::sin(turn)), across(-std::sin(turn), 0, std::cos(turn));
  const Vector3 foot = -3.0 * std::cos(turn) * Vector3::UnitX();
  std::vector<Vector3> points;
  for (const double y : {-0.2, 0.2})
    for (const Vector3& corner : {Vector3(foot), Vector3(foot + 0.1 * across), Vector3(foot + 3.0 * along),
                                  Vector3(foot + 3.0 * along + 0.1 * across)})
      points.push_back(corner + y * Vector3::UnitY());
  test_support::LimitScene scene;
  scene.law = joint(friction);
  scene.add("ladder", Polyhedron(make_convex_hull(points)));
  scene.add_fixed(Polyhedron(make_box({-5, -1, -1}, {2, 1, 0})));
  scene.add_fixed(Polyhedron(make_box({0, -1, 0}, {1, 1, 5})));
  return scene.build();
}

TEST(RigidVerdict, ARigidLadderSlidesOrStands) {
  for (const double friction : {0.30, 0.34}) {
    Simulation simulation = ladder(friction);
    EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::moving) << friction;
  }
  for (const double friction : {0.37, 0.5}) {
    Simulation simulation = ladder(friction);
    EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium) << friction;
  }
}

TEST(RigidVerdict, ATableTiltedToItsFrictionAngleHasAnAnswer) {
  for (const int order : {0, 1, 2}) {
    SimulationSettings settings;
    settings.time_step = 0.1;
    const double slope = 30.0 * 3.14159265358979323846 / 180.0;
    std::vector<double> times;
    std::vector<Vector3> values;
    for (int k = 0; k <= 10; ++k) {
      times.push_back(0.1 * k);
      values.push_back(g * Vector3(std::sin(0.1 * k * slope), 0.0, -std::cos(0.1 * k * slope)));
    }
    settings.gravity_history = {times, values};
    Simulation simulation(
        models(
            test_support::block_of("A", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.3})), rock, order),
            fixed_block(Polyhedron(make_box({-2, -2, -1}, {2, 2, 0})))),
        {{}, {}}, test_support::same_law(joint(tangent_of(30.0))), settings);
    EXPECT_NE(run_static(simulation, 1.0), StaticStatus::not_converged) << order;
  }
}

}  // namespace
}  // namespace ashlar::rigid_verdict_test

#include "solver/ground/side_column.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/solid/shapes.hpp"

namespace ashlar::side_column_test {
namespace {

/// lambda = mu = 8e7 Pa, c_s = 200 m/s.
const Material soil{2000.0, 2e8, 0.25};
const double shear_modulus = 8e7;

Vector3 traction_at(const std::vector<Load>& loads, const Vector3& place, double time) {
  Vector3 sum = Vector3::Zero();
  for (const Load& load : loads) sum += load.history.at(time) * load.field(place);
  return sum;
}

/// A layer of 4 m that moves with 0.1 m/s along x, sheared by 1/1000.
SideColumn sheared_column() {
  SideColumn side;
  side.column = std::make_shared<const FreeFieldColumn>(std::vector<GroundLayer>{{0.0, 4.0, soil, 1}});
  side.times = {0.0, 1.0};
  Eigen::MatrixX3d displacement = Eigen::MatrixX3d::Zero(2, 3), velocity = displacement;
  displacement(1, 0) = 4e-3;
  velocity.col(0).setConstant(0.1);
  side.displacement.assign(2, displacement);
  side.velocity.assign(2, velocity);
  return side;
}

// Z v = rho c_p v along the normal x; shear of mu e acts along the axis on the face.
TEST(SideColumn, ItActsWithItsVelocityAndStress) {
  const Polyhedron box(make_box({0, 0, 0}, {6, 2, 4}));
  const std::vector<int> faces = outer_faces(box, {{6, 0, 0}, Vector3::UnitX()});
  const std::vector<Load> loads = column_loads(sheared_column(), box, soil, faces);
  // Velocities of two nodes and the displacement of one; nothing moves along y and z.
  EXPECT_EQ(loads.size(), 3U);
  const Vector3 expected(2000.0 * 200.0 * std::sqrt(3.0) * 0.1, 0.0, shear_modulus * 1e-3);
  for (const double height : {0.5, 2.0, 3.5})
    EXPECT_NEAR((traction_at(loads, {6, 1, height}, 0.5) - expected).norm(), 0.0, 1e-6);
}

// On the opposite side stress has the other sign, the resistance the same.
TEST(SideColumn, StressChangesItsSignWithTheNormal) {
  const Polyhedron box(make_box({0, 0, 0}, {6, 2, 4}));
  const std::vector<int> faces = outer_faces(box, {{0, 0, 0}, -Vector3::UnitX()});
  const std::vector<Load> loads = column_loads(sheared_column(), box, soil, faces);
  const Vector3 expected(2000.0 * 200.0 * std::sqrt(3.0) * 0.1, 0.0, -shear_modulus * 1e-3);
  EXPECT_NEAR((traction_at(loads, {0, 1, 2}, 0.5) - expected).norm(), 0.0, 1e-6);
}

// The base takes up what comes back, so that nothing is left of a wave but a displacement of twice its integral, 1/2 0.1 s
// 0.2 m/s along x.
TEST(SideColumn, AWaveLeavesItThroughTheBase) {
  SimulationSettings settings;
  settings.integrator = Integrator::average_acceleration;
  settings.time_step = 5e-4;
  const GroundWave wave{{0.0, 0.05, 0.1}, {Vector3::Zero(), {0.2, 0, 0}, Vector3::Zero()}};
  const SideColumn side = side_column({{0, 0, -1}, {0, 0, -3}}, {{0.0, 4.0, soil, 3}}, wave, settings, 1.0);
  EXPECT_EQ(side.axis, Vector3::UnitZ());
  EXPECT_EQ(side.origin, Vector3(0, 0, -1));
  ASSERT_EQ(side.displacement.size(), side.times.size());
  ASSERT_EQ(side.displacement.back().rows(), 4);
  for (Eigen::Index node = 0; node < 4; ++node) {
    EXPECT_NEAR((side.displacement.back().row(node) - Eigen::RowVector3d(0.02, 0, 0)).norm(), 0.0, 2e-5);
    EXPECT_NEAR(side.velocity.back().row(node).norm(), 0.0, 2e-5);
  }
}

TEST(SideColumn, ItNeedsALayer) {
  EXPECT_THROW((void)side_column({}, {}, {}, SimulationSettings(), 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::side_column_test

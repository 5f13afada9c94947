#include "apps/program/verify/verification_contacts.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ashlar::verification_contacts_test {
namespace {

BlockDefinition cube_at(double x) {
  return define_block(Polyhedron(make_box({x, 0, 0}, {x + 1, 1, 1})), {2000, 1e9, 0.2}, 1);
}

TEST(ContactScene, TiedBlocksMoveAsOneBody) {
  ContactScene scene;
  scene.settings.gravity.setZero();
  scene.settings.time_step = 0.01;
  scene.add(cube_at(0), {{0, 0, 1}, Vector3::Zero()});
  scene.add(cube_at(1), {{0, 0, 1}, Vector3::Zero()});
  scene.tie(0, 1);
  Simulation simulation = scene.build();
  take_step(simulation, 1.0);
  EXPECT_TRUE(simulation.contacts().empty());
  EXPECT_NEAR(centroid(simulation, 0).z(), 0.51, 1e-12);
  EXPECT_NEAR(centroid(simulation, 1).z(), 0.51, 1e-12);
}

TEST(ContactScene, BlocksWithoutACommonFaceCannotBeTied) {
  ContactScene scene;
  scene.add(cube_at(0));
  scene.add(cube_at(1.5));
  scene.tie(0, 1);
  EXPECT_THROW((void)scene.build(), std::invalid_argument);
}

TEST(ContactScene, GravityTurnsWithTheScene) {
  Placement on_its_side;  // z becomes x
  on_its_side.turn << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  ContactScene scene(on_its_side);
  scene.settings.time_step = 0.1;
  scene.settings.gravity = {0, 0, -10};
  scene.add(cube_at(0));
  Simulation simulation = scene.build();
  take_step(simulation, 1.0);
  // g t^2/2 down from the centroid at (0.5, 0.5, 0.5).
  EXPECT_NEAR((centroid(simulation, 0) - Vector3(0.45, 0.5, 0.5)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace ashlar::verification_contacts_test

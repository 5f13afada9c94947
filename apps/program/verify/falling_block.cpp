#include "apps/program/verify/falling_block.hpp"

#include "apps/program/verify/verification_contacts.hpp"

namespace ashlar {

Vector3 falling_block_tip() {
  return {8, 0, 0};
}

Simulation falling_block(const FallingBlock& example, const Placement& placement) {
  const Material rock{3600.0, 5e8, 0.2};
  constexpr double side = 1.5;
  ContactScene scene(placement);
  scene.settings.time_step = example.time_step;
  scene.settings.area_springs = example.area_springs;
  scene.settings.curved_surface = example.curved_surface;
  scene.settings.search.chord_tolerance = example.chord_tolerance;
  scene.settings.search.subdivisions = example.subdivisions;
  scene.settings.contact_distance = 1.5e-3;
  scene.settings.depth.allowed_depth = example.allowed_depth;
  const double stiffness = example.area_springs ? example.stiffness : example.stiffness * side * side / 4.0;
  *scene.law = {stiffness, stiffness, tangent_of(30), 0.0, 0.0, example.area_springs};
  const double low = 0.5 + example.drop;
  BlockDefinition cube =
      define_block(Polyhedron(make_box({6.5, -0.5 * side, low}, {8.0, 0.5 * side, low + side})), rock, 1);
  BlockDefinition beam =
      define_block(Polyhedron(make_box({0, -1.5, -0.5}, {8, 1.5, 0.5})), rock, example.order);
  beam.supports.push_back({Plane{{0, 0, 0}, Vector3::UnitX()}});
  beam.followed.push_back(falling_block_tip());
  beam.sub_face_levels = example.subdivisions;
  cube.formulation = beam.formulation = example.formulation;
  scene.add(std::move(cube), {{0, 0, -example.speed}, Vector3::Zero()});
  scene.add(std::move(beam));
  Simulation simulation = scene.build();
  simulation.settle_supported_blocks();
  return simulation;
}

}  // namespace ashlar

// The library in some lines: a stone of 1 m slides on a floor. It starts at 1 m/s; friction of tan(phi) = 0.3
// slows it by 0.3 g, so that in 0.1 s it goes 0.1 - 0.3 g 0.1^2 / 2 = 0.0853 m.
#include <ashlar/solver.hpp>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>

namespace {

ashlar::BlockModel box(const char* name, const ashlar::Vector3& low, const ashlar::Vector3& high,
                       bool fixed) {
  ashlar::BlockDefinition block;
  block.name = name;
  block.solid = std::make_shared<const ashlar::Polyhedron>(ashlar::make_box(low, high));
  block.material = {.density = 2700.0, .young_modulus = 1e10, .poisson_ratio = 0.2};
  block.fixed = fixed;
  return ashlar::BlockModel(block);
}

}  // namespace

int main() {
  for (const auto& [name, version] : ashlar::solver_library_versions()) {
    std::cout << name << ' ' << version << '\n';
  }
  const std::vector<ashlar::BlockModel> blocks = {box("floor", {-2, -2, -1}, {2, 2, 0}, true),
                                                  box("stone", {-0.5, -0.5, 0}, {0.5, 0.5, 1}, false)};
  ashlar::JointLaw joint;
  joint.normal_stiffness = ashlar::automatic_normal_stiffness(
      ashlar::stiffness_source(blocks[0]), ashlar::stiffness_source(blocks[1]), joint.area_springs);
  joint.shear_stiffness = 0.5 * joint.normal_stiffness;
  joint.friction = 0.3;
  ashlar::InitialMotion motion;
  motion.velocity.x() = 1.0;
  ashlar::Simulation simulation(blocks, {{}, motion}, [&](int, int) { return joint; }, {});
  while (!simulation.reached(0.1)) {
    if (simulation.step(0.1) != ashlar::StepStatus::accepted) return EXIT_FAILURE;
  }
  const ashlar::Vector3 start(0.0, 0.0, 0.5);
  const ashlar::Vector3 end =
      simulation.states()[1].position.transpose() * simulation.blocks()[1].basis().values(start);
  std::cout << "the stone has gone " << end.x() << " m\n";
  return std::abs(end.x() - 0.0853) < 1e-3 ? EXIT_SUCCESS : EXIT_FAILURE;
}

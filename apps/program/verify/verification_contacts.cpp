#include "apps/program/verify/verification_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "solver/state/automatic.hpp"

namespace ashlar {

int ContactScene::add(BlockDefinition block, const InitialMotion& motion) {
  blocks_.emplace_back(placed(std::move(block), placement_));
  motions_.push_back(placed(motion, placement_));
  return static_cast<int>(blocks_.size()) - 1;
}

int ContactScene::add_fixed(Polyhedron solid) {
  BlockDefinition block = define_block(std::move(solid), {}, 1);
  block.fixed = true;
  return add(std::move(block));
}

Simulation ContactScene::build() {
  SimulationSettings turned = settings;
  turned.gravity = placement_.direction(settings.gravity);
  std::vector<BlockModel> blocks = std::exchange(blocks_, {});
  std::vector<TieRequest> ties;
  for (const auto& [a, b] : std::exchange(ties_, {}))
    ties.push_back(
        {a, b,
         automatic_tie_stiffness(blocks[static_cast<std::size_t>(a)], blocks[static_cast<std::size_t>(b)])});
  Simulation simulation(
      std::move(blocks), std::exchange(motions_, {}), [same = law](int, int) { return *same; }, turned, ties);
  const bool may_be_apart = std::exchange(all_tied_, false);
  for (const TieRequest& tie : ties) {
    if (!may_be_apart && !simulation.system().are_tied(tie.a, tie.b))
      throw std::invalid_argument("tied blocks have no common face");
  }
  return simulation;
}

void ContactScene::tie_all() {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      if (!blocks_[a].fixed() && !blocks_[b].fixed())
        ties_.push_back({static_cast<int>(a), static_cast<int>(b)});
    }
  }
  all_tied_ = true;
}

BlockDefinition bar_along_x(double from, double to, int order) {
  const Vector3 low(from, 0, 0), high(to, 0.1, 0.1);
  BlockDefinition block = define_block(Polyhedron(make_box(low, high)), {8000, 200e9, 0.0}, order);
  for (const Vector3& corner : {low, high}) {
    for (int axis = 0; axis < 3; ++axis)
      block.supports.push_back({Plane{corner, Vector3::Unit(axis)}, {false, true, true}});
  }
  return block;
}

ContactScene meeting_bars(int pieces, int order) {
  ContactScene scene;
  scene.settings.gravity.setZero();
  scene.settings.contact_distance = 1e-5;
  scene.settings.search.subdivisions = 0;
  // The compression of the bars is F L/(E A) = 1e-4 m, that of the springs between them a five-hundredth of it.
  *scene.law = {1e14, 0.0, 0.0, 0.0, 0.0, true};
  for (const double side : {-1.0, 1.0}) {
    for (int k = 0; k < pieces; ++k) {
      const double from = std::min(side, 0.0) + static_cast<double>(k) / pieces;
      const double to = std::min(side, 0.0) + (k + 1.0) / pieces;
      const int piece = scene.add(bar_along_x(from, to, order), {{-0.5 * side, 0, 0}, Vector3::Zero()});
      if (k > 0) scene.tie(piece - 1, piece);
    }
  }
  return scene;
}

double momentum_along_x(const Simulation& simulation, int blocks) {
  double sum = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(blocks); ++k)
    sum += simulation.blocks()[k].momentum(simulation.states()[k]).x();
  return sum;
}

void choose_as_for_statics(ContactScene& scene, double size, double young_modulus, double friction) {
  const AutomaticRatios ratios;
  scene.settings.augmented = true;
  scene.settings.contact_distance = ratios.distance * size;
  scene.settings.search.contact_angle = ratios.angle_degrees * std::numbers::pi / 180.0;
  scene.settings.search.chord_tolerance = ratios.chord_tolerance * size;
  scene.settings.search.subdivisions = 0;
  scene.settings.multipliers.penetration_tolerance =
      ratios.penetration_tolerance * scene.settings.contact_distance;
  scene.law->normal_stiffness = ratios.normal_stiffness * young_modulus / size;
  scene.law->shear_stiffness = ratios.shear_to_normal_stiffness * scene.law->normal_stiffness;
  scene.law->friction = friction;
  scene.law->rigid = true;
}

Eigen::Matrix3d slope(double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3::UnitY()).toRotationMatrix();
}

Polyhedron hull_of(const std::vector<Vector3>& points) {
  return Polyhedron(make_convex_hull(points));
}

double tangent_of(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180.0);
}

void take_step(Simulation& simulation, double end_time) {
  if (simulation.step(end_time) != StepStatus::accepted)
    throw std::runtime_error("a step could not be taken");
}

void run_until(Simulation& simulation, double time) {
  while (!simulation.reached(time)) take_step(simulation, time);
}

StaticStatus find_equilibrium(Simulation& simulation, double time) {
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(time);
  return status;
}

VerificationCheck check_status(std::string what, Simulation& simulation, StaticStatus expected) {
  return check_absolute(std::move(what), find_equilibrium(simulation) == expected ? 1.0 : 0.0, 1.0, 0.0);
}

VerificationCheck check_energy(std::string what, const Simulation& simulation) {
  const double most = std::max(simulation.largest_step_residual(), simulation.ledger().redetection_gained);
  return check_absolute(std::move(what), most / simulation.largest_energy(), 0.0, 1e-8);
}

Vector3 centroid(const Simulation& simulation, int block) {
  const auto index = static_cast<std::size_t>(block);
  return simulation.states()[index].position.row(0) / std::sqrt(simulation.blocks()[index].basis().volume());
}

}  // namespace ashlar

// Cases of friction on slopes: blocks that stick, slide or topple on an incline, a wedge between two planes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/program/verify/sliding_wedge.hpp"
#include "apps/program/verify/verification_contacts.hpp"

namespace ashlar {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
const Material slope_rock{2700.0, 1e10, 0.2};

/// A block on an incline, its lower edge at the origin. Degrees and m.
struct BlockOnIncline {
  double incline;
  double length;  ///< along the slope
  double height;
  double friction_angle;
  double stiffness = 1.0;  ///< factor on the stiffness of rock and springs
};

Simulation on_incline(const BlockOnIncline& block, const SimulationSettings& settings,
                      const Placement& placement) {
  const auto& [incline, length, height, friction_angle, stiffness] = block;
  ContactScene scene(placement);
  scene.settings = settings;
  *scene.law = {2e10 * stiffness,     1e10 * stiffness, tangent_of(friction_angle), 0.0, 0.0,
                settings.area_springs};
  Material material = slope_rock;
  material.young_modulus *= stiffness;
  const Placement lowered{slope(incline)};
  const double far = 3.0 * length;
  scene.add_fixed(
      placed(Polyhedron(make_box({-far, -2.0 * length, -length}, {far, 2.0 * length, 0})), lowered));
  const Polyhedron box(make_box({-length, -0.5 * length, 0}, {0, 0.5 * length, height}));
  scene.add(define_block(placed(box, lowered), material, 1));
  return scene.build();
}

std::vector<VerificationCheck> incline_stick(const Placement& placement) {
  SimulationSettings settings;
  settings.time_step = 0.01;
  Simulation simulation = on_incline({30, 1, 0.5, 31}, settings, placement);
  // The elastic displacement first: equilibrium with the weight on springs and block.
  const bool found = find_equilibrium(simulation, 0.0) == StaticStatus::equilibrium;
  const Vector3 start = centroid(simulation, 1);
  double drift = found ? 0.0 : std::nan("");
  while (!simulation.reached(10.0)) {
    take_step(simulation, 10.0);
    drift = std::max(drift, (centroid(simulation, 1) - start).norm());
  }
  return {check_absolute("largest drift in 10 s, m", drift, 0.0, 1e-9),
          check_absolute("rejected steps", static_cast<double>(simulation.rejections().size()), 0.0, 0.0)};
}

std::vector<VerificationCheck> incline_slide(const Placement& placement) {
  struct Slide {
    double incline;
    double friction_angle;
    double reference;
  };
  std::vector<VerificationCheck> checks;
  for (const auto& [incline, phi, reference] :
       {Slide{30, 20, 0.9064074}, Slide{30, 0, 2.4525}, Slide{45, 30, 1.4659009}}) {
    SimulationSettings settings;
    settings.time_step = 2e-3;
    Simulation simulation = on_incline({incline, 1, 0.5, phi}, settings, placement);
    const Vector3 start = centroid(simulation, 1);
    run_until(simulation, 1.0);
    const Vector3 down = placement.direction(slope(incline) * Vector3::UnitX());
    const std::string where = fmt::format("alpha {}, phi {}", incline, phi);
    checks.push_back(check_relative("way in 1 s, m, " + where, down.dot(centroid(simulation, 1) - start),
                                    reference, 0.005));
    checks.push_back(
        check_energy("residual of a step or gain of contacts over largest energy, " + where, simulation));
  }
  return checks;
}

/// The mode of a block on an incline is that of statics: it slides if tan(psi) > tan(phi), it topples if tan(psi) >
/// length / height. A block that starts to rotate about its lower edge without sliding has the angular acceleration 3
/// g (h sin(psi) - b cos(psi)) / (2 (b^2 + h^2)): 0.17398 rad/s^2 for b = 10, h = 25, psi = 40 and g = 10.
std::vector<VerificationCheck> slide_or_topple(const Placement& placement) {
  SimulationSettings settings;
  settings.gravity = {0, 0, -10};
  settings.area_springs = false;  // springs at the corners: rotation about the edge of the block
  std::vector<VerificationCheck> checks;
  Simulation stable = on_incline({40, 10, 10, 40.1}, settings, placement);
  checks.push_back(check_status("10 x 10, phi 40.1 stands", stable, StaticStatus::equilibrium));
  Simulation sliding = on_incline({40, 10, 5, 20}, settings, placement);
  checks.push_back(check_status("10 x 5, phi 20 moves", sliding, StaticStatus::moving));
  const auto slides = sliding.moving_blocks();
  const double expected = 10.0 * (std::sin(40 * degree) - std::cos(40 * degree) * tangent_of(20));
  checks.push_back(check_relative("it slides, m/s^2", slides.empty() ? 0.0 : slides[0].acceleration.norm(),
                                  expected, 0.02));
  Simulation toppling = on_incline({40, 10, 25, 30}, settings, placement);
  checks.push_back(check_status("10 x 25, phi 30 moves", toppling, StaticStatus::moving));
  Simulation start = on_incline({40, 10, 25, 30, 1e3}, settings, placement);
  constexpr double time = 0.4;
  run_until(start, time);
  const Eigen::Matrix3d gradient =
      start.states()[1].position.transpose() * mean_gradients(start.blocks()[1].basis());
  const Eigen::Matrix3d rotation = polar_decomposition(gradient).rotation;
  const double angle = Eigen::AngleAxisd(rotation).angle();
  checks.push_back(check_relative("10 x 25 topples, rad/s^2", 2.0 * angle / (time * time), 0.17398, 0.02));
  return checks;
}

Simulation wedge_on(const SlidingWedge& wedge, double friction_angle, const SimulationSettings& settings,
                    const Placement& placement) {
  ContactScene scene(placement);
  scene.settings = settings;
  // Soft shear springs: stiff ones would act normal to the line during settling and jam the wedge a little.
  *scene.law = {2e10, 1e8, tangent_of(friction_angle), 0.0, 0.0, settings.area_springs};
  wedge.add_to(scene, slope_rock);
  return scene.build();
}

std::vector<VerificationCheck> wedge(const Placement& placement) {
  const SlidingWedge wedge;
  // Along the line: slip W against friction tan(phi) grip W.
  const double critical = std::atan(wedge.slip / wedge.grip) / degree;
  std::vector<VerificationCheck> checks = {
      check_absolute("friction angle of the formula, deg", critical, 33.357, 5e-4)};
  Simulation above = wedge_on(wedge, 33.457, {}, placement);
  checks.push_back(check_status("stands at phi 33.457", above, StaticStatus::equilibrium));
  Simulation below = wedge_on(wedge, 33.257, {}, placement);
  checks.push_back(check_status("slides at phi 33.257", below, StaticStatus::moving));
  SimulationSettings settings;
  settings.time_step = 2e-3;
  Simulation sliding = wedge_on(wedge, 20, settings, placement);
  const Vector3 start = centroid(sliding, 2);
  constexpr double time = 0.6;
  run_until(sliding, time);
  const double way = placement.direction(wedge.line).dot(centroid(sliding, 2) - start);
  checks.push_back(
      check_relative("acceleration over g at phi 20", 2.0 * way / (time * time) / 9.81, 0.26944, 0.01));
  checks.push_back(check_energy("residual of a step or gain of contacts over largest energy", sliding));
  return checks;
}

/// A block under a constant pressure moved to and fro by supports on rigid ground. From one end to the other it moves
/// by 2 U, of which 2 mu N / ks is deformation of the springs before it slides against mu N.
std::vector<VerificationCheck> cyclic_shear() {
  constexpr double side = 2.0, p = 1e5, ks = 1e9, mu = 0.6, amplitude = 1e-3;
  constexpr double normal = p * side * side;
  ContactScene scene;
  scene.settings.gravity.setZero();
  scene.settings.time_step = 0.025;
  *scene.law = {1e10, ks, mu, 0.0, 0.0, true};
  scene.add_fixed(Polyhedron(make_box({-2, -2, -1}, {4, 4, 0})));
  BlockDefinition block =
      define_block(Polyhedron(make_box({0, 0, 0}, {side, side, 1})), {2500, 1e10, 0.0}, 1);
  const Vector3 far(amplitude, 0, 0), none = Vector3::Zero();
  const SupportHistory history{{0.1, 0.35, 0.85, 1.35}, {none, far, -far, far}};
  for (const double x : {0.0, side})
    block.supports.push_back({Plane{{x, 0, 0}, Vector3::UnitX()}, {true, true, false}, history});
  block.loads.push_back({Plane{{0, 0, 1}, Vector3::UnitZ()}, true, {0, 0, -p}, {}});
  scene.add(std::move(block));
  Simulation simulation = scene.build();
  const bool out = find_equilibrium(simulation, 0.35) == StaticStatus::equilibrium;
  const double friction = simulation.ledger().friction;
  const bool back = find_equilibrium(simulation, 1.35) == StaticStatus::equilibrium;
  const double reference = 4.0 * mu * normal * (amplitude - mu * normal / (ks * side * side));
  const double nan = std::nan("");
  return {check_relative("work of friction in a cycle, J",
                         out && back ? simulation.ledger().friction - friction : nan, reference, 1e-6)};
}

constexpr VerificationCase slope_case_list[] = {
    {"incline-stick", "a block held by friction for 10 s", incline_stick},
    {"incline-slide", "blocks that slide down inclines", incline_slide},
    {"block-slide-or-topple", "modes of a block on an incline", slide_or_topple},
    {"wedge", "a wedge on two planes", wedge},
    {"cyclic-shear", "a block moved to and fro under pressure", cyclic_shear},
};

}  // namespace

std::span<const VerificationCase> slope_cases() {
  return slope_case_list;
}

}  // namespace ashlar

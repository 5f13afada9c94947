// Cases of joint properties besides friction: degradation of strength, dilation, damping.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/verification_values.hpp"

namespace ashlar {
namespace {

/// Components of the force between the first pair of blocks along the surface and normal to it, N.
struct JointForce {
  double shear;
  double normal;
};
JointForce force_of(const Simulation& simulation, const Vector3& normal) {
  const Vector3 force = force_on_a(simulation.contacts().at(0));
  const double across = normal.dot(force);
  return {(force - across * normal).norm(), std::abs(across)};
}

/// A block under a constant pressure moved by supports against its friction and cohesion, out, back and out again.
/// The resistance is c A + N tan(phi) once, then N tan(phi_r).
std::vector<VerificationCheck> shear_degradation() {
  constexpr double side = 2.0, p = 1e5, ks = 1e9, peak = 0.6, residual = 0.3, cohesion = 2e4, far = 1e-3;
  constexpr double area = side * side, normal = p * area;
  constexpr double strength = peak * normal + cohesion * area, elastic = strength / (ks * area);
  ContactScene scene;
  scene.settings.gravity.setZero();
  scene.settings.time_step = 0.025;
  *scene.law = {1e10, ks, peak, cohesion, 0.0, true};
  scene.law->residual = {residual, 0.0, 0.0};
  scene.add_fixed(Polyhedron(make_box({-2, -2, -1}, {4, 4, 0})));
  BlockDefinition block =
      define_block(Polyhedron(make_box({0, 0, 0}, {side, side, 1})), {2500, 1e10, 0.0}, 1);
  const auto along = [](double way) { return Vector3(way, 0, 0); };
  const SupportHistory history{
      {0.1, 0.2, 0.3, 0.5, 1.0, 1.5},
      {along(0), along(0.99 * elastic), along(1.01 * elastic), along(far), along(-far), along(far)}};
  for (const double x : {0.0, side})
    block.supports.push_back({Plane{{x, 0, 0}, Vector3::UnitX()}, {true, true, false}, history});
  block.loads.push_back({Plane{{0, 0, 1}, Vector3::UnitZ()}, true, {0, 0, -p}, {}});
  scene.add(std::move(block));
  Simulation simulation = scene.build();
  bool balanced = true;
  const auto go_to = [&](double time) {
    balanced = balanced && find_equilibrium(simulation, time) == StaticStatus::equilibrium;
  };
  std::vector<VerificationCheck> checks;
  go_to(0.2);
  checks.push_back(check_relative("shear force just before the peak, N",
                                  force_of(simulation, Vector3::UnitZ()).shear, 0.99 * strength, 1e-6));
  go_to(0.3);
  checks.push_back(check_relative("and just beyond it", force_of(simulation, Vector3::UnitZ()).shear,
                                  residual * normal, 1e-6));
  checks.push_back(
      check_relative("area that broke, m^2", simulation.histories().begin()->second.broken, area, 1e-9));
  go_to(0.5);
  const double friction = simulation.ledger().friction;
  go_to(1.5);
  checks.push_back(check_relative("work of friction in a cycle, J",
                                  balanced ? simulation.ledger().friction - friction : std::nan(""),
                                  4.0 * residual * normal * (far - residual * normal / (ks * area)), 1e-6));
  return checks;
}

/// A block whose top is pressed down by w and moved sideways by u: sigma = K (w + s tan(psi)), s = u - sigma tan(phi)
/// C with K and C of the joint and the block in series.
std::vector<VerificationCheck> dilation_under_stiffness() {
  constexpr double height = 0.5, young = 1e9, kn = 4e9, ks = 3e9, w = 1e-4, u = 4e-4, friction = 0.5;
  std::vector<VerificationCheck> checks;
  for (const bool multipliers : {false, true}) {
    for (const double angle : {0.0, 5.0, 15.0}) {
      ContactScene scene;
      scene.settings.gravity.setZero();
      scene.settings.time_step = 0.1;
      scene.settings.contact_distance = 1e-5;
      scene.settings.augmented = multipliers;
      scene.settings.multipliers.penetration_tolerance = 1e-8;
      *scene.law = {kn, ks, friction, 0.0, 0.0, true};
      scene.law->dilation = tangent_of(angle);
      scene.add_fixed(Polyhedron(make_box({-1, -1, -1}, {1, 1, 0})));
      BlockDefinition block =
          define_block(Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, height})), {2500, young, 0.0}, 1);
      block.supports.push_back({Plane{{0, 0, height}, Vector3::UnitZ()},
                                {true, true, true},
                                {{0.0, 0.2, 1.0}, {Vector3::Zero(), {0, 0, -w}, {u, 0, -w}}}});
      scene.add(std::move(block));
      Simulation simulation = scene.build();
      const bool balanced = find_equilibrium(simulation) == StaticStatus::equilibrium;
      const JointForce force = force_of(simulation, Vector3::UnitZ());
      const double stiffness = 1.0 / (height / young + (multipliers ? 0.0 : 1.0 / kn));
      const double give = 2.0 * height / young + (multipliers ? 0.0 : 1.0 / ks);
      const double reference =
          stiffness * (w + tangent_of(angle) * u) / (1.0 + stiffness * tangent_of(angle) * friction * give);
      const std::string where = fmt::format("psi {}, {}", angle, multipliers ? "multipliers" : "springs");
      checks.push_back(check_relative("normal stress, Pa, " + where, balanced ? force.normal : std::nan(""),
                                      reference, 1e-5));
      checks.push_back(
          check_relative("shear stress over it, " + where, force.shear / force.normal, friction, 1e-6));
    }
  }
  return checks;
}

/// A slab accelerates along the direction given by dilation. m x'' = -N tan(phi), m z'' = N - m g and z = x tan(psi)
/// give N = m g / (1 + tan(phi) tan(psi)).
std::vector<VerificationCheck> dilation_under_load(const Placement& placement) {
  constexpr double friction = 0.5, speed = 1.5;
  const double dilation = tangent_of(10);
  std::vector<VerificationCheck> checks;
  for (const bool multipliers : {false, true}) {
    ContactScene scene(placement);
    scene.settings.time_step = 1e-3;
    scene.settings.rest.sleeps = false;
    scene.settings.augmented = multipliers;
    *scene.law = {1e10, 5e9, friction, 0.0, 0.0, true};
    scene.law->dilation = dilation;
    scene.add_fixed(Polyhedron(make_box({-2, -2, -1}, {4, 2, 0})));
    scene.add(define_block(Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.1})), {2500, 1e9, 0.2}, 1),
              {{speed, 0, speed * dilation}, Vector3::Zero()});
    Simulation simulation = scene.build();
    const Vector3 start = centroid(simulation, 1);
    run_until(simulation, 0.5);
    const Vector3 moved = centroid(simulation, 1) - start;
    const double slip = placement.direction(Vector3::UnitX()).dot(moved);
    const double risen = placement.direction(Vector3::UnitZ()).dot(moved);
    const std::string where = multipliers ? ", multipliers" : ", springs";
    checks.push_back(check_relative("rise over slip" + where, risen / slip, dilation, 1e-4));
    checks.push_back(
        check_relative("slip until rest, m" + where, slip,
                       speed * speed * (1.0 + friction * dilation) / (2.0 * earth_gravity * friction), 1e-3));
    checks.push_back(
        check_energy("residual of a step or gain of contacts over largest energy" + where, simulation));
  }
  return checks;
}

/// A cube that lands on a damped joint rebounds with e = exp(-z/sqrt(1 - z^2) (pi - 2 asin z)) of its speed
/// (Kelvin-Voigt contact without tension). A cube bonded to it oscillates with exp(-z w t).
std::vector<VerificationCheck> joint_damping(const Placement& placement) {
  constexpr double kn = 5e7, density = 2000.0, side = 0.2, speed = 0.1;
  const double natural = std::sqrt(kn / (density * side));
  const Vector3 up = placement.direction(Vector3::UnitZ());
  const auto cube_on_plate = [&](double share, bool bonded, double step, double velocity) {
    ContactScene scene(placement);
    scene.settings.gravity.setZero();
    scene.settings.integrator = Integrator::average_acceleration;
    scene.settings.time_step = step;
    scene.settings.rest.sleeps = false;
    *scene.law = {kn, kn, 0.5, 0.0, 0.0, true};
    if (bonded) scene.law->cohesion = scene.law->tensile_strength = 1e12;
    scene.law->damping = share;
    scene.add_fixed(Polyhedron(make_box({-1, -1, -1}, {1, 1, 0})));
    scene.add(define_block(Polyhedron(make_box({-0.1, -0.1, 0}, {0.1, 0.1, side})), {density, 1e12, 0.0}, 0),
              {{0, 0, velocity}, Vector3::Zero()});
    return scene.build();
  };
  const auto speed_of = [&](const Simulation& simulation) {
    const Vector3 mean =
        simulation.states()[1].velocity.row(0) / std::sqrt(simulation.blocks()[1].basis().volume());
    return up.dot(mean);
  };
  std::vector<VerificationCheck> checks;
  for (const double share : {0.05, 0.2, 0.6}) {
    Simulation landing = cube_on_plate(share, false, 1e-3 / natural, -speed);
    run_until(landing, 4.0 / natural);
    const double reference =
        std::exp(-share / std::sqrt(1.0 - share * share) * (std::numbers::pi - 2.0 * std::asin(share)));
    checks.push_back(check_relative(fmt::format("restitution, damping {}", share), speed_of(landing) / speed,
                                    reference, 1e-3));
    const double half = std::numbers::pi / (natural * std::sqrt(1.0 - share * share));
    Simulation swing = cube_on_plate(share, true, half / 200.0, speed);
    run_until(swing, 2.0 * half);
    const double decrement = 2.0 * std::numbers::pi * share / std::sqrt(1.0 - share * share);
    checks.push_back(check_relative(fmt::format("logarithmic decrement, damping {}", share),
                                    std::log(speed / speed_of(swing)), decrement, 1e-3));
  }
  return checks;
}

constexpr VerificationCase joint_case_list[] = {
    {"shear-degradation", "a joint sheared beyond its peak, to and fro", shear_degradation},
    {"dilation-stiffness", "a joint that dilates between stiff blocks", dilation_under_stiffness},
    {"dilation-load", "a slab that rises as it slides", dilation_under_load},
    {"joint-damping", "a cube that lands on a damped joint, and swings on it", joint_damping},
};

}  // namespace

std::span<const VerificationCase> joint_cases() {
  return joint_case_list;
}

}  // namespace ashlar

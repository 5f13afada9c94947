// Cases of bonds with fracture energy, and of ties that break.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/program/verify/verification_contacts.hpp"

namespace ashlar {
namespace {

constexpr double tension = 1e5, shear = 2e5, energy_of_tension = 50.0, energy_of_shear = 200.0;
constexpr double end_opening = 2.0 * energy_of_tension / tension;
constexpr double block_height = 0.5, young_modulus = 1e9;

JointLaw softening(double stiffness) {
  JointLaw law{stiffness, stiffness, 0.5, shear, tension, true};
  law.fracture = {energy_of_tension, energy_of_shear};
  return law;
}

/// A block of 1 m x 1 m x 0.5 m on a floor, whose top moves with time.
ContactScene driven_block(const JointLaw& law, const SupportHistory& history, int order) {
  ContactScene scene;
  scene.settings.gravity.setZero();
  *scene.law = law;
  scene.add_fixed(Polyhedron(make_box({-1, -1, -1}, {2, 2, 0})));
  BlockDefinition block =
      define_block(Polyhedron(make_box({0, 0, 0}, {1, 1, block_height})), {2500, young_modulus, 0.0}, order);
  block.supports.push_back({Plane{{0, 0, block_height}, Vector3::UnitZ()}, {true, true, true}, history});
  scene.add(std::move(block));
  return scene;
}

/// Work of supports less the energy that blocks and springs hold, J.
double spent(const Simulation& simulation) {
  const Ledger& ledger = simulation.ledger();
  return ledger.applied - ledger.kinetic - ledger.elastic - ledger.contact;
}

/// A block is pulled off, or along, by 3 mm: work and dissipation are the fracture energy, for all steps, integrators
/// and springs.
std::vector<VerificationCheck> fracture_work() {
  constexpr double way = 3e-3, speed = 0.01;
  std::vector<VerificationCheck> checks;
  struct Run {
    const char* name;
    Integrator integrator;
    double step, stiffness;
    int order;
  };
  for (const Run& run : {Run{"dda", Integrator::dda, 1e-3, 1e10, 1},
                         {"dda", Integrator::dda, 2e-4, 1e10, 1},
                         {"dda", Integrator::dda, 1e-3, 1e12, 1},
                         {"dda", Integrator::dda, 1e-3, 1e9, 2},
                         {"average-acceleration", Integrator::average_acceleration, 1e-3, 1e10, 1},
                         {"average-acceleration", Integrator::average_acceleration, 2e-4, 1e12, 2},
                         {"generalized-alpha", Integrator::generalized_alpha, 2e-4, 1e10, 1}}) {
    // Order 2 bends when it is sheared: friction where it is pressed dissipates more than the bond.
    for (const bool along : {false, true}) {
      if (along && run.order > 1) continue;
      const Vector3 direction = along ? Vector3::UnitX() : Vector3::UnitZ();
      const SupportHistory history{{0.0, way / speed}, {Vector3::Zero(), way * direction}};
      ContactScene scene = driven_block(softening(run.stiffness), history, run.order);
      scene.settings.integrator = run.integrator;
      scene.settings.time_step = run.step;
      scene.settings.search.subdivisions = 0;
      Simulation simulation = scene.build();
      run_until(simulation, way / speed);
      const double reference = along ? energy_of_shear : energy_of_tension;
      const std::string where =
          fmt::format(", {}, {}, {} s, {:g} Pa/m, order {}", along ? "shear" : "tension", run.name, run.step,
                      run.stiffness, run.order);
      checks.push_back(check_relative("dissipation, J" + where, simulation.ledger().friction, reference,
                                      along ? 1e-2 : 1e-6));
      checks.push_back(check_relative("work of the supports, J" + where, spent(simulation), reference, 1e-2));
      checks.push_back(check_energy("energy" + where, simulation));
    }
  }
  return checks;
}

/// The same in a static analysis: forces on the falling branch, where block and bond are in series.
std::vector<VerificationCheck> fracture_branch() {
  constexpr double stiffness = 1e10, peak = tension / stiffness;
  std::vector<VerificationCheck> checks;
  const std::vector<double> ways = {5e-5, 2e-4, 5e-4, 9e-4};
  std::vector<double> times = {0.0};
  std::vector<Vector3> places = {Vector3::Zero()};
  for (std::size_t k = 0; k < ways.size(); ++k) {
    times.push_back(static_cast<double>(k + 1));
    places.emplace_back(0.0, 0.0, ways[k]);
  }
  times.push_back(5.0);
  places.emplace_back(0.0, 0.0, 5e-4);
  ContactScene scene = driven_block(softening(stiffness), SupportHistory{times, places}, 1);
  scene.settings.time_step = 0.2;
  Simulation simulation = scene.build();
  const auto traction = [&](double time) {
    if (find_equilibrium(simulation, time) != StaticStatus::equilibrium) return std::nan("");
    return std::abs(force_on_a(simulation.contacts().at(0)).z());
  };
  // Series:  u = t height/E + w,  t = T (wf - w)/(wf - w0).
  const double fall = tension / (end_opening - peak), soft = block_height / young_modulus;
  const auto opening = [&](double way) { return (way - soft * fall * end_opening) / (1.0 - soft * fall); };
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const double elastic = ways[k] / (soft + 1.0 / stiffness);
    const double reference = elastic < tension ? elastic : fall * (end_opening - opening(ways[k]));
    checks.push_back(check_relative(fmt::format("traction at {} m, Pa", ways[k]), traction(times[k + 1]),
                                    reference, 1e-6));
  }
  // Unloading by 0.4 mm: along the secant of the largest opening.
  const double largest = opening(ways.back());
  const double secant = fall * (end_opening - largest) / largest;
  checks.push_back(check_relative("traction after unloading to 5e-4 m, Pa", traction(5.0),
                                  5e-4 / (soft + 1.0 / secant), 1e-6));
  return checks;
}

/// A block bonded to the floor by a tie of 1e5 Pa in tension and 2e5 Pa in shear stands up to them and not beyond.
std::vector<VerificationCheck> breaking_tie() {
  std::vector<VerificationCheck> checks;
  for (const bool along : {false, true}) {
    for (const double share : {0.99, 1.01}) {
      ContactScene scene;
      scene.settings.gravity.setZero();
      scene.settings.time_step = 0.5;
      const double stiffness = 1e5 * young_modulus / std::cbrt(0.02);
      *scene.law = {stiffness, stiffness, 0.5, shear, tension, true};
      scene.law->rigid = true;
      scene.add_fixed(Polyhedron(make_box({-1, -1, -1}, {2, 2, 0})));
      // Thin, so that shear does not bend it off.
      BlockDefinition block =
          define_block(Polyhedron(make_box({0, 0, 0}, {1, 1, 0.02})), {2500, young_modulus, 0.0}, 1);
      // Each force acts at the tied face, where it has no arm.
      const Vector3 pull = share * (along ? Vector3(shear, 0, 0) : Vector3(0, 0, tension));
      const Vector3 out(0, 0, along ? -1 : 1);
      block.loads.push_back({Plane{{0, 0, along ? 0.0 : 0.02}, out}, true, pull, {}});
      scene.add(std::move(block));
      Simulation simulation = scene.build();
      checks.push_back(
          check_status(fmt::format("{} of its strength in {}", share, along ? "shear" : "tension"),
                       simulation, share < 1.0 ? StaticStatus::equilibrium : StaticStatus::moving));
    }
  }
  return checks;
}

constexpr VerificationCase bond_case_list[] = {
    {"fracture-work", "a bonded block pulled off and along, by fracture energy", fracture_work},
    {"fracture-branch", "the falling branch of a bond, and its unloading", fracture_branch},
    {"tie-breaks", "a tied block loaded up to and beyond its tie", breaking_tie},
};

}  // namespace

std::span<const VerificationCase> bond_cases() {
  return bond_case_list;
}

}  // namespace ashlar

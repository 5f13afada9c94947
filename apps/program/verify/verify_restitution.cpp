// Cases of joints with a coefficient of restitution.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/verification_values.hpp"

namespace ashlar {
namespace {

Vector3 velocity_of(const Simulation& simulation, int block) {
  const auto k = static_cast<std::size_t>(block);
  return simulation.states()[k].velocity.row(0).transpose() /
         std::sqrt(simulation.blocks()[k].basis().volume());
}

/// How contact is modelled.
struct Contact {
  const char* name;
  double stiffness;  ///< Pa/m
  bool multipliers;
};
constexpr Contact stiff{"stiff springs", 1e11, false}, soft{"soft springs", 1e7, false},
    rigid{"multipliers", 1e9, true};

struct Scheme {
  const char* name;
  Integrator integrator;
};
constexpr Scheme schemes[] = {{"dda", Integrator::dda},
                              {"average-acceleration", Integrator::average_acceleration},
                              {"generalized-alpha", Integrator::generalized_alpha}};

/// A scene of cubes of 0.2 m over a floor at z = 0.
ContactScene scene_of(const Placement& placement, const Contact& contact, Integrator integrator, double step,
                      double restitution) {
  ContactScene scene(placement);
  scene.settings.integrator = integrator;
  scene.settings.time_step = step;
  scene.settings.contact_distance = 2e-4;
  scene.settings.rest.sleeps = false;
  scene.settings.augmented = contact.multipliers;
  *scene.law = {contact.stiffness, 0.5 * contact.stiffness, 0.3, 0.0, 0.0, true};
  scene.law->restitution = restitution;
  scene.add_fixed(Polyhedron(make_box({-1, -1, -1}, {1, 1, 0})));
  return scene;
}

BlockDefinition cube(double bottom, int order) {
  return define_block(Polyhedron(make_box({-0.1, -0.1, bottom}, {0.1, 0.1, bottom + 0.2})), {2500, 1e10, 0.2},
                      order);
}

/// Heights of the first two rebounds, m: of the energy of the centroid in flight, which sampling does not change.
std::array<double, 2> rebounds(Simulation& simulation, const Vector3& up, double rest, double time) {
  std::array<double, 2> heights{};
  int impacts = 0;
  double last = -1.0;
  while (!simulation.reached(time)) {
    take_step(simulation, time);
    const double speed = up.dot(velocity_of(simulation, 1));
    if (speed > 0.0 && last < 0.0) ++impacts;
    if (impacts > 2) break;
    const double height = up.dot(centroid(simulation, 1)) - rest + 0.5 * speed * speed / earth_gravity;
    if (impacts > 0 && speed > 0.0) heights[static_cast<std::size_t>(impacts) - 1] = height;
    last = speed;
  }
  return heights;
}

/// A cube that falls by h rebounds to e^2 h and e^4 h, with all integrators and steps, stiff and soft springs and
/// multipliers, rigid and deformable. What it loses is booked.
std::vector<VerificationCheck> restitution_heights(const Placement& placement) {
  constexpr double drop = 0.2;
  const Vector3 up = placement.direction(Vector3::UnitZ());
  std::vector<VerificationCheck> checks;
  const auto run = [&](const Contact& contact, const Scheme& scheme, double step, int order, double e) {
    ContactScene scene = scene_of(placement, contact, scheme.integrator, step, e);
    scene.add(cube(drop, order));
    Simulation simulation = scene.build();
    const double rest = up.dot(centroid(simulation, 1)) - drop;
    const std::array<double, 2> heights = rebounds(simulation, up, rest, 1.2);
    const std::string where =
        fmt::format("e {}, {}, {}, {} s, order {}", e, contact.name, scheme.name, step, order);
    checks.push_back(check_relative("first height, m, " + where, heights[0], e * e * drop, 1e-3));
    checks.push_back(check_relative("second, " + where, heights[1], e * e * e * e * drop, 1e-2));
    checks.push_back(check_energy("energy, " + where, simulation));
    const double lost = 0.008 * 2500 * earth_gravity * drop * (1.0 - e * e * e * e);
    if (e < 1.0)
      checks.push_back(
          check_relative("loss in two impacts, J, " + where, simulation.ledger().damping, lost, 1e-2));
  };
  for (const Scheme& scheme : schemes)
    for (const double step : {1e-4, 1e-3, 4e-3}) run(stiff, scheme, step, 1, 0.3);
  for (const int order : {0, 1}) {
    for (const Contact& contact : {soft, rigid}) run(contact, schemes[0], 1e-3, order, 0.3);
    run(stiff, schemes[0], 4e-3, order, 1.0);
  }
  return checks;
}

/// Without restitution a cube that falls 0.2 m stays where it lands.
std::vector<VerificationCheck> plastic_landing(const Placement& placement) {
  const Vector3 up = placement.direction(Vector3::UnitZ());
  std::vector<VerificationCheck> checks;
  for (const Contact& contact : {stiff, rigid}) {
    for (const int order : {0, 1}) {
      ContactScene scene = scene_of(placement, contact, Integrator::dda, 1e-3, 0.0);
      scene.add(cube(0.2, order));
      Simulation simulation = scene.build();
      const double rest = up.dot(centroid(simulation, 1)) - 0.2;
      run_until(simulation, 0.21);
      double highest = 0.0;
      while (!simulation.reached(0.4)) {
        take_step(simulation, 0.4);
        highest = std::max(highest, std::abs(up.dot(centroid(simulation, 1)) - rest));
      }
      checks.push_back(check_absolute(
          fmt::format("largest distance from rest after landing, m, {}, order {}", contact.name, order),
          highest, 0.0, 4e-6));
    }
  }
  return checks;
}

/// A cube strikes an equal one at rest in free flight: with e the velocities are (1 - e)/2 and (1 + e)/2 of the first.
std::vector<VerificationCheck> restitution_exchange(const Placement& placement) {
  constexpr double speed = 2.0;
  const Vector3 along = placement.direction(Vector3::UnitX());
  std::vector<VerificationCheck> checks;
  for (const Contact& contact : {stiff, rigid}) {
    for (const int order : {0, 1, 2}) {
      for (const double e : {0.5, 1.0}) {
        ContactScene scene = scene_of(placement, contact, Integrator::average_acceleration, 1e-3, e);
        scene.settings.gravity.setZero();
        scene.settings.search.subdivisions = 0;
        const auto moved = [&](double x) {
          return define_block(Polyhedron(make_box({x - 0.1, -0.1, 1.0}, {x + 0.1, 0.1, 1.2})),
                              {2500, 1e10, 0.2}, order);
        };
        scene.add(moved(-0.25), {{speed, 0, 0}, Vector3::Zero()});
        scene.add(moved(0.0));
        Simulation simulation = scene.build();
        run_until(simulation, 0.05);
        const std::string where = fmt::format(", {}, order {}, e {}", contact.name, order, e);
        checks.push_back(check_absolute("velocity of the first, m/s" + where,
                                        along.dot(velocity_of(simulation, 1)), 0.5 * (1.0 - e) * speed,
                                        1e-6));
        checks.push_back(check_absolute("of the second" + where, along.dot(velocity_of(simulation, 2)),
                                        0.5 * (1.0 + e) * speed, 1e-6));
        checks.push_back(check_energy("energy" + where, simulation));
      }
    }
  }
  return checks;
}

/// A cube lands flat at v with the velocity u along the floor: friction of the impulse takes tan(phi) (1 + e) v.
std::vector<VerificationCheck> oblique_impact(const Placement& placement) {
  constexpr double v = 1.0, u = 2.0, e = 0.5;
  const Vector3 up = placement.direction(Vector3::UnitZ()), along = placement.direction(Vector3::UnitX());
  std::vector<VerificationCheck> checks;
  for (const Contact& contact : {stiff, rigid}) {
    for (const int order : {0, 1}) {
      ContactScene scene = scene_of(placement, contact, Integrator::dda, 1e-3, e);
      scene.settings.gravity.setZero();
      scene.add(cube(0.05, order), {{u, 0, -v}, Vector3::Zero()});
      Simulation simulation = scene.build();
      run_until(simulation, 0.08);
      const std::string where = fmt::format(", {}, order {}", contact.name, order);
      checks.push_back(check_absolute("velocity along the floor, m/s" + where,
                                      along.dot(velocity_of(simulation, 1)), u - 0.3 * (1.0 + e) * v, 1e-6));
      checks.push_back(check_absolute("and off it" + where, up.dot(velocity_of(simulation, 1)), e * v, 1e-6));
    }
  }
  return checks;
}

/// Five cubes in a row, of which the first arrives at v. Where they touch, the impulses of one moment are those of Moreau:
/// Newton's law holds at the contact that closes, the others do not close, and the last four leave as one: momentum
/// v = v_1 + 4 v_2 and v_2 - v_1 = v give -3/5 and 2/5 of v. With gaps between them there is one impact after another,
/// and only the last one leaves, at v.
std::vector<VerificationCheck> cradle(const Placement& placement) {
  constexpr double speed = 2.0;
  const Vector3 along = placement.direction(Vector3::UnitX());
  std::vector<VerificationCheck> checks;
  for (const Contact& contact : {stiff, rigid}) {
    for (const double gap : {0.0, 1e-3}) {
      ContactScene scene = scene_of(placement, contact, Integrator::average_acceleration, 1e-3, 1.0);
      scene.settings.gravity.setZero();
      const auto moved = [&](double x) {
        return define_block(Polyhedron(make_box({x, -0.1, 1.0}, {x + 0.2, 0.1, 1.2})), {2500, 1e10, 0.2}, 0);
      };
      scene.add(moved(-0.25), {{speed, 0, 0}, Vector3::Zero()});
      for (int k = 0; k < 4; ++k) scene.add(moved(k * (0.2 + gap)));
      Simulation simulation = scene.build();
      run_until(simulation, 0.05);
      const std::array<double, 5> touching = {-0.6, 0.4, 0.4, 0.4, 0.4}, apart = {0.0, 0.0, 0.0, 0.0, 1.0};
      for (int k = 1; k <= 5; ++k) {
        const double share = (gap == 0.0 ? touching : apart)[static_cast<std::size_t>(k - 1)];
        checks.push_back(
            check_absolute(fmt::format("velocity of cube {}, m/s, {} m apart, {}", k, gap, contact.name),
                           along.dot(velocity_of(simulation, k)), share * speed, 1e-6));
      }
      checks.push_back(check_energy(fmt::format("energy, {} m apart, {}", gap, contact.name), simulation));
    }
  }
  return checks;
}

constexpr VerificationCase restitution_case_list[] = {
    {"restitution-heights", "a cube that falls and rebounds twice", restitution_heights},
    {"restitution-none", "a cube that lands and stays", plastic_landing},
    {"restitution-exchange", "two equal cubes that meet in flight", restitution_exchange},
    {"restitution-cradle", "five cubes in a row, struck by the first", cradle},
    {"restitution-oblique", "a cube that lands in motion along the floor", oblique_impact},
};

}  // namespace

std::span<const VerificationCase> restitution_cases() {
  return restitution_case_list;
}

}  // namespace ashlar

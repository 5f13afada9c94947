// Cases of dynamic contact: a bounce, impact of bars, a wave through a joint, a rocking block, the falling block.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/program/verify/verification_contacts.hpp"

namespace ashlar {
namespace {

/// A cube that falls 1 m onto rigid ground with stiffness k. With w^2 = k/m and v^2 = 2 g h it penetrates by g/w^2 +
/// sqrt((g/w^2)^2 + (v/w)^2) and rebounds after 2 (pi - atan(v w/g)) / w. The dda step dissipates energy in
/// proportion to its length.
std::vector<VerificationCheck> bounce(const Placement& placement) {
  constexpr double k = 1e9, drop = 1.0, time_of_contact = 0.0110044;
  std::vector<VerificationCheck> checks;
  struct Scheme {
    const char* name;
    Integrator integrator;
    int steps;  ///< during contact
  };
  for (const auto& [name, integrator, steps] :
       {Scheme{"average-acceleration", Integrator::average_acceleration, 50},
        {"dda", Integrator::dda, 200}}) {
    ContactScene scene(placement);
    scene.settings.integrator = integrator;
    scene.settings.time_step = time_of_contact / steps;
    *scene.law = {k / 2.25, k / 2.25, 0.0, 0.0, 0.0, true};
    scene.add_fixed(Polyhedron(make_box({-3, -3, -1}, {3, 3, 0})));
    scene.add(define_block(Polyhedron(make_box({-0.75, -0.75, drop}, {0.75, 0.75, drop + 1.5})),
                           {3600, 1e14, 0.0}, 1));
    Simulation simulation = scene.build();
    const double start = simulation.ledger().gravity;
    double first = 0.0, last = 0.0, gain = 0.0;
    while (!simulation.reached(0.5)) {
      take_step(simulation, 0.5);
      const Ledger& ledger = simulation.ledger();
      const double energy = ledger.kinetic + ledger.elastic + ledger.contact + ledger.gravity;
      gain = std::max(gain, (energy - start) / (12150 * 9.81 * drop));
      if (simulation.report().locked + simulation.report().sliding == 0) continue;
      if (first == 0.0) first = simulation.time();
      last = simulation.time();
    }
    checks.push_back(check_relative(fmt::format("penetration, m, {}", name), simulation.largest_penetration(),
                                    0.0155593, 0.01));
    checks.push_back(check_relative(fmt::format("time of contact, s, {}", name),
                                    last - first + scene.settings.time_step, time_of_contact, 0.01));
    checks.push_back(check_absolute(fmt::format("gain of energy, {}", name), gain, 0.0, 1e-9));
    checks.push_back(check_energy(
        fmt::format("residual of a step or gain of contacts over largest energy, {}", name), simulation));
  }
  return checks;
}

/// A bar along x of 0.1 x 0.1 whose sides and ends move only along x.
BlockDefinition bar(double from, double to, int order) {
  const Vector3 low(from, 0, 0), high(to, 0.1, 0.1);
  BlockDefinition block = define_block(Polyhedron(make_box(low, high)), {8000, 200e9, 0.0}, order);
  for (const Vector3& corner : {low, high}) {
    for (int axis = 0; axis < 3; ++axis)
      block.supports.push_back({Plane{corner, Vector3::Unit(axis)}, {false, true, true}});
  }
  return block;
}

/// Impact of two equal bars at 1 m/s. A wave of stress rho c v/2 runs through each of them at c = sqrt(E/rho) and
/// returns as release after 2 L/c. Until then the contact force is F = A rho c v/2, and they exchange their
/// velocities. A bar is a chain of short blocks, so that the wave front can be resolved.
std::vector<VerificationCheck> bar_impact() {
  constexpr double duration = 4e-4, force = 2e5, impulse = 80.0;
  constexpr int pieces = 12, steps = 400;
  ContactScene scene;
  scene.settings.gravity.setZero();
  scene.settings.integrator = Integrator::generalized_alpha;
  scene.settings.time_step = duration / steps;
  scene.settings.contact_distance = 1e-5;
  scene.settings.search.subdivisions = 0;
  // The compression of the bars is F L/(E A) = 1e-4 m, that of the springs between them a five-hundredth of it.
  *scene.law = {1e14, 0.0, 0.0, 0.0, 0.0, true};
  for (const double side : {-1.0, 1.0}) {
    for (int k = 0; k < pieces; ++k) {
      const double from = std::min(side, 0.0) + static_cast<double>(k) / pieces;
      const double to = std::min(side, 0.0) + (k + 1.0) / pieces;
      const int piece = scene.add(bar(from, to, 3), {{-0.5 * side, 0, 0}, Vector3::Zero()});
      if (k > 0) scene.tie(piece - 1, piece);
    }
  }
  Simulation simulation = scene.build();
  const auto momentum = [&] {
    double sum = 0.0;
    for (std::size_t k = 0; k < pieces; ++k)
      sum += simulation.blocks()[k].momentum(simulation.states()[k]).x();
    return sum;
  };
  const double before = momentum();
  double first = -1.0, last = 0.0, mean = 0.0;
  while (!simulation.reached(1.5 * duration)) {
    take_step(simulation, 1.5 * duration);
    const double end = simulation.time(), step = simulation.report().step;
    double pressed = 0.0;
    for (const PairRecord& record : simulation.contacts()) pressed += std::abs(force_on_a(record).x());
    if (pressed > 0.0 && first < 0.0) first = end - step;
    if (pressed > 0.0) last = end;
    const double middle = end - 0.5 * step;
    if (middle > 0.25 * duration && middle < 0.75 * duration) mean += pressed * step / (0.5 * duration);
  }
  return {check_relative("force, mean of the middle half, N", mean, force, 0.01),
          check_relative("duration, s", last - first, duration, 0.05),
          check_relative("impulse, N s", before - momentum(), impulse, 0.01),
          check_energy("residual of a step or gain of contacts over largest energy", simulation)};
}

/// Amplitude of a wave at its angular frequency from samples over whole periods.
class Amplitude {
 public:
  explicit Amplitude(double frequency) : frequency_(frequency) {}
  void add(double time, double value, double step) {
    cosine_ += value * std::cos(frequency_ * time) * step;
    sine_ += value * std::sin(frequency_ * time) * step;
    span_ += step;
  }
  [[nodiscard]] double value() const { return 2.0 * std::hypot(cosine_, sine_) / span_; }

 private:
  double frequency_;
  double cosine_ = 0.0;
  double sine_ = 0.0;
  double span_ = 0.0;
};

/// A wave of 1 kHz along two bars of 6 m with a joint between them, generated by a traction at one end. The joint has
/// strength, so that it transmits tension too. Transmitted: 1 / sqrt(1 + (w z / (2 kn))^2), reflected: the rest of
/// the energy. Waves are measured over one period after their front has passed and before the echo from an end
/// arrives.
std::vector<VerificationCheck> joint_wave() {
  constexpr double length = 6.0, speed = 5000.0, z = 4e7, kn = 1e11, period = 1e-3, p = 1e5;
  constexpr double frequency = 2.0 * std::numbers::pi / period;
  ContactScene scene;
  scene.settings.gravity.setZero();
  scene.settings.integrator = Integrator::average_acceleration;
  scene.settings.time_step = period / 50.0;
  scene.settings.search.subdivisions = 0;
  *scene.law = {kn, kn, 0.0, 1e9, 1e9, true};
  BlockDefinition left = bar(0, length, 7);
  Load shake{Plane{{0, 0, 0}, Vector3::UnitX()}, true, {p, 0, 0}, {}};
  for (int k = 0; k <= 800; ++k) {
    const double time = k * period / 200.0;
    // Increased smoothly over one period, so that no other frequencies are excited.
    const double ease = time < period ? 0.5 * (1.0 - std::cos(0.5 * frequency * time)) : 1.0;
    shake.history.times.push_back(time);
    shake.history.values.push_back(ease * std::sin(frequency * time));
  }
  left.loads.push_back(std::move(shake));
  scene.add(std::move(left));
  scene.add(bar(length, 2.0 * length, 7));
  Simulation simulation = scene.build();
  // From stress and velocity: s - z v travels to the right, s + z v to the left, each halved.
  const auto wave = [&](std::size_t block, double x, double direction) {
    const Vector3 at(x, 0.05, 0.05);
    const BlockModel& model = simulation.blocks()[block];
    const BlockState& state = simulation.states()[block];
    const double v = (state.velocity.transpose() * model.basis().values(at)).x();
    return 0.5 * (model.stress(state, at)(0, 0) - direction * z * v);
  };
  Amplitude incident(frequency), reflected(frequency), transmitted(frequency);
  const double near = length - 1.0, far = length + 1.0;
  while (!simulation.reached(4.0 * period)) {
    take_step(simulation, 4.0 * period);
    const double time = simulation.time(), step = simulation.report().step;
    const double arrival = near / speed + period;
    const auto during = [&](double start) {
      return time > start + 0.5 * step && time < start + period + 0.5 * step;
    };
    if (during(arrival)) incident.add(time, wave(0, near, 1.0), step);
    if (during(arrival + 2.0 * (length - near) / speed)) reflected.add(time, wave(0, near, -1.0), step);
    if (during(far / speed + period)) transmitted.add(time, wave(1, far, 1.0), step);
  }
  const double ratio = 0.5 * frequency * z / kn;
  const double passes = 1.0 / std::sqrt(1.0 + ratio * ratio);
  return {check_relative("transmitted share of the formula", passes, 0.62268, 1e-5),
          check_relative("incident amplitude, Pa", incident.value(), p, 0.03),
          check_relative("transmitted share", transmitted.value() / incident.value(), 0.62268, 0.03),
          check_relative("reflected share", reflected.value() / incident.value(), 0.78248, 0.03),
          check_energy("residual of a step or gain of contacts over largest energy", simulation)};
}

/// Time in which a rigid block of half sides b, h rotates about its edge from an angle to its face: theta'' = -p^2
/// sin(alpha - theta), p^2 = 3 g/(4 R).
double fall_time(double b, double h, double start) {
  const double alpha = std::atan(b / h);
  const double squared_p = 0.75 * 9.81 / std::hypot(b, h);
  // theta'^2 = 2 p^2 (cos(alpha - start) - cos(alpha - theta)); theta = start (1 - s^2) removes the singularity.
  constexpr int steps = 2000;
  double time = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double s = (k + 0.5) / steps;
    const double theta = start * (1.0 - s * s);
    const double speed = std::sqrt(2.0 * squared_p * (std::cos(alpha - start) - std::cos(alpha - theta)));
    time += 2.0 * start * s / speed / steps;
  }
  return time;
}

/// Until it first hits the ground with its face, a quarter of the period without dissipation.
std::vector<VerificationCheck> rocking_block(const Placement& placement) {
  const double b = 0.1, h = 0.3;
  const double start = 0.5 * std::atan(b / h);
  ContactScene scene(placement);
  scene.settings.time_step = 5e-4;
  // The edge rests on stiff springs for a thousand of their periods: without dissipation of unresolved vibrations
  // they would grow until the edge loses contact.
  scene.settings.integrator = Integrator::generalized_alpha;
  scene.settings.area_springs = false;
  *scene.law = {1e9, 1e9, tangent_of(60), 0.0, 0.0, false};
  scene.add_fixed(Polyhedron(make_box({-1, -1, -0.5}, {1, 1, 0})));
  const Placement lifted{slope(start * 180.0 / std::numbers::pi)};
  // Lifted about its edge at the origin.
  scene.add(
      define_block(placed(Polyhedron(make_box({-0.2, 0, 0}, {0, 0.2, 0.6})), lifted), {2500, 1e10, 0.2}, 1));
  Simulation simulation = scene.build();
  const Vector3 left = placement.point(lifted.point({-0.2, 0.1, 0}));
  const auto left_edge = [&] {
    const Vector3 place =
        simulation.states()[1].position.transpose() * simulation.blocks()[1].basis().values(left);
    return placement.point_back(place).z();
  };
  double before = left_edge(), time = 0.0;
  while (!simulation.reached(1.0)) {
    take_step(simulation, 1.0);
    const double now = left_edge();
    if (now <= 0.0) {
      time = simulation.time() - simulation.report().step * now / (now - before);
      break;
    }
    before = now;
  }
  return {check_relative("period of the formula, s", 4.0 * fall_time(b, h, start), 1.0954, 1e-4),
          check_relative("period, s", 4.0 * time, 1.0954, 0.02),
          check_energy("residual of a step or gain of contacts over largest energy", simulation)};
}

constexpr VerificationCase impact_case_list[] = {
    {"bounce", "a cube that falls on rigid ground", bounce},
    {"bar-impact", "two bars that meet: force, duration, impulse", bar_impact},
    {"joint-wave", "a wave through a joint", joint_wave},
    {"rocking-block", "a block that falls back on its base", rocking_block},
};

}  // namespace

std::span<const VerificationCase> impact_cases() {
  return impact_case_list;
}

}  // namespace ashlar

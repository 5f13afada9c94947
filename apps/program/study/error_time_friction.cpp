// Sliding pulse and arch of error_time_problems.hpp.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "apps/program/study/error_time_problems.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/voussoir_arch.hpp"
#include "solver/accuracy/static_accuracy.hpp"

namespace ashlar {
namespace {

constexpr double not_found = std::numeric_limits<double>::infinity();

constexpr VoussoirArch thick_arch{8, 0.2};
constexpr double joint_stiffness = 1e10;  ///< N/m^3

Simulation arch_of(const std::vector<int>& orders) {
  ContactScene scene;
  const Material rock{2500.0, 1e9, 0.2};
  const double size = thick_arch.add_to(scene, rock, orders);
  choose_as_for_statics(scene, size, rock.young_modulus, tangent_of(60));
  // Multipliers of high orders redistribute over a whole joint, in a hundred iterations; springs need ten.
  scene.settings.augmented = scene.law->rigid = false;
  scene.law->normal_stiffness = scene.law->shear_stiffness = joint_stiffness;
  return scene.build();
}

/// How far the outer edge of the crown sinks, m: the voussoirs on both sides meet there.
double sinking_of_crown(const Simulation& simulation) {
  const Vector3 crown(0.0, 0.5 * VoussoirArch::depth, thick_arch.outer_radius());
  const std::size_t beside = thick_arch.count / 2;
  return -displacement(simulation.blocks()[beside], simulation.states()[beside].position, crown).z();
}

/// In equilibrium; not_found without one.
double sinking_with(const std::vector<int>& orders) {
  Simulation simulation = arch_of(orders);
  return find_equilibrium(simulation) == StaticStatus::equilibrium ? sinking_of_crown(simulation) : not_found;
}

std::vector<int> all_of(int order) {
  return std::vector<int>(static_cast<std::size_t>(thick_arch.count), order);
}

}  // namespace

double slide_of_pulse(const SlidingPulse& pulse) {
  const double rate = pulse.peak / (0.5 * pulse.duration);
  const double start = pulse.friction / rate, half = (pulse.peak - pulse.friction) / rate;
  const double fastest = rate * half * half;
  const double at_end = fastest - 0.5 * rate * start * start;
  return rate * half * half * half + fastest * start - rate * start * start * start / 6.0 +
         0.5 * at_end * at_end / pulse.friction;
}

double sliding_error(const ErrorTimeSetting& setting) {
  constexpr double gravity = 10.0, tangent = 0.3, end = 0.65;
  constexpr SlidingPulse pulse{8.0, tangent * gravity, 0.4};
  ContactScene scene;
  scene.settings.integrator = setting.integrator;
  scene.settings.time_step = setting.time_step;
  scene.settings.gravity = {0, 0, -gravity};
  scene.settings.gravity_history = {{0.0, 0.5 * pulse.duration, pulse.duration},
                                    {{0, 0, -gravity}, {pulse.peak, 0, -gravity}, {0, 0, -gravity}}};
  *scene.law = {1e9, 1e9, tangent, 0.0, 0.0, true};
  scene.settings.augmented = scene.law->rigid = !setting.springs;
  scene.add_fixed(Polyhedron(make_box({-2, -2, -1}, {4, 2, 0})));
  const int block = scene.add(
      define_block(Polyhedron(make_box({-1, -0.5, 0}, {1, 0.5, 0.5})), {2000, 1e8, 0.2}, setting.order));
  Simulation simulation = scene.build();
  const Vector3 before = centroid(simulation, block);
  if (!runs_to(simulation, end, setting)) return not_found;
  return std::abs((centroid(simulation, block) - before).norm() / slide_of_pulse(pulse) - 1.0);
}

ArchReference arch_reference() {
  static const ArchReference reference = [] {
    constexpr int fine = 6;
    const double sinking = sinking_with(all_of(fine));
    return ArchReference{sinking, std::abs(sinking_with(all_of(fine - 1)) / sinking - 1.0)};
  }();
  return reference;
}

double arch_error(const ErrorTimeSetting& setting) {
  std::vector<int> orders = all_of(setting.accuracy > 0.0 ? 1 : setting.order);
  if (setting.accuracy > 0.0) {
    Simulation simulation = arch_of(orders);
    std::vector<bool> chosen(simulation.blocks().size(), true);
    const GoalValues crown = [](const Simulation& now) {
      return std::vector<Goal>{{"crown", {sinking_of_crown(now)}}};
    };
    AccuracyRounds rounds;
    if (find_equilibrium(simulation, 1.0, {setting.accuracy, std::move(chosen)}, crown, rounds,
                         [] { return true; }) != StaticStatus::equilibrium)
      return not_found;
    if (setting.estimate != nullptr)
      *setting.estimate = accuracy_estimate(crown(simulation), rounds).largest();
    for (std::size_t k = 0; k < orders.size(); ++k) orders[k] = simulation.blocks()[k].order();
  }
  return std::abs(sinking_with(orders) / arch_reference().sinking - 1.0);
}

}  // namespace ashlar

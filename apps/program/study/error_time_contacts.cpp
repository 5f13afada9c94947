// Chosen steps, the block that rocks and the bars that meet of error_time_problems.hpp.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "apps/program/study/error_time_problems.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "solver/accuracy/motion_accuracy.hpp"

namespace ashlar {
namespace {

constexpr double not_run = std::numeric_limits<double>::infinity();
const GoalValues energies_alone = [](const Simulation&) { return std::vector<Goal>(); };

}  // namespace

bool runs_to(Simulation& simulation, double time, const ErrorTimeSetting& setting) {
  MotionAccuracyState state;
  const bool chosen = setting.accuracy > 0.0;
  if (chosen) {
    simulation.set_time_step(time / automatic_steps);
    state.scales = pilot_run(simulation, time, energies_alone, [] { return true; })->scales;
  }
  while (!simulation.reached(time)) {
    if (chosen) choose_step(simulation, {setting.accuracy, time / 16.0, time}, energies_alone, state);
    if (simulation.step(time) != StepStatus::accepted) return false;
    if (chosen) note_step(simulation, state);
  }
  if (chosen && setting.estimate != nullptr)
    *setting.estimate =
        state.error + state.noise + (state.scales.impact_speed > 0.0 ? state.impact_error : 0.0);
  return true;
}

double rocking_error(const ErrorTimeSetting& setting) {
  constexpr double half_width = 0.1, half_height = 0.3, exact = 1.0954 / 4.0, end = 0.35;
  const double start = 0.5 * std::atan(half_width / half_height);
  ContactScene scene;
  scene.settings.time_step = setting.time_step;
  scene.settings.integrator = setting.integrator;
  scene.settings.area_springs = false;
  *scene.law = {1e9, 1e9, tangent_of(60), 0.0, 0.0, false};
  scene.add_fixed(Polyhedron(make_box({-1, -1, -0.5}, {1, 1, 0})));
  const Placement lifted{slope(start * 180.0 / std::numbers::pi)};
  const Polyhedron upright(make_box({-2.0 * half_width, 0, 0}, {0, 0.2, 2.0 * half_height}));
  scene.add(define_block(placed(upright, lifted), {2500, 1e10, 0.2}, setting.order));
  Simulation simulation = scene.build();
  const Vector3 edge = lifted.point({-2.0 * half_width, 0.1, 0});
  const auto height = [&] {
    return simulation.blocks()[1].motion_of(simulation.states()[1], edge).place.z();
  };
  double before = height();
  while (!simulation.reached(end)) {
    if (simulation.step(end) != StepStatus::accepted) return not_run;
    const double now = height();
    if (now <= 0.0) {
      const double time = simulation.time() - simulation.report().step * now / (now - before);
      return std::abs(time / exact - 1.0);
    }
    before = now;
  }
  return not_run;
}

double bar_impact_error(const ErrorTimeSetting& setting) {
  constexpr double duration = 4e-4, exact = 80.0;
  constexpr int pieces = 6;
  ContactScene scene = meeting_bars(pieces, setting.order);
  scene.settings.integrator = setting.integrator;
  scene.settings.time_step = setting.time_step * duration;
  Simulation simulation = scene.build();
  const double before = momentum_along_x(simulation, pieces);
  if (!runs_to(simulation, 1.5 * duration, setting)) return not_run;
  return std::abs((before - momentum_along_x(simulation, pieces)) / exact - 1.0);
}

}  // namespace ashlar

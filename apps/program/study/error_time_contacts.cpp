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

/// Steps to an end time, of a chosen length if the setting has an accuracy, as a run of a scene takes them.
class ChosenSteps {
 public:
  ChosenSteps(Simulation& simulation, double end, const ErrorTimeSetting& setting)
      : simulation_(simulation), end_(end), setting_(setting), chosen_(setting.accuracy > 0.0) {
    if (!chosen_) return;
    simulation.set_time_step(end / automatic_steps);
    state_.scales = pilot_run(simulation, end, energies_alone, [] { return true; })->scales;
  }

  /// @return false if a step cannot be taken
  [[nodiscard]] bool take() {
    if (chosen_) choose_step(simulation_, {setting_.accuracy, end_ / 16.0, end_}, energies_alone, state_);
    if (simulation_.step(end_) != StepStatus::accepted) return false;
    if (chosen_) note_step(simulation_, state_);
    return true;
  }

  void tell_estimate() const {
    if (chosen_ && setting_.estimate != nullptr)
      *setting_.estimate =
          state_.error + state_.noise + (state_.scales.impact_speed > 0.0 ? state_.impact_error : 0.0);
  }

 private:
  Simulation& simulation_;
  double end_;  ///< s
  const ErrorTimeSetting& setting_;
  bool chosen_;
  MotionAccuracyState state_;
};

}  // namespace

bool runs_to(Simulation& simulation, double time, const ErrorTimeSetting& setting) {
  ChosenSteps steps(simulation, time, setting);
  while (!simulation.reached(time))
    if (!steps.take()) return false;
  steps.tell_estimate();
  return true;
}

double rocking_error(const ErrorTimeSetting& setting) {
  constexpr double half_width = 0.1, half_height = 0.3, exact = 1.0954 / 4.0, end = 0.35;
  const double start = 0.5 * std::atan(half_width / half_height);
  ContactScene scene;
  if (setting.accuracy == 0.0) scene.settings.time_step = setting.time_step;
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
  ChosenSteps steps(simulation, end, setting);
  double before = height();
  while (!simulation.reached(end)) {
    if (!steps.take()) return not_run;
    const double now = height();
    if (now <= 0.0) {
      const double time = simulation.time() - simulation.report().step * now / (now - before);
      steps.tell_estimate();
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

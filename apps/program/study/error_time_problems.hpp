// Problems of error_time_study.hpp beside its first four: each runs with given or chosen orders or steps.
#pragma once

#include "apps/scene/model/scene_analysis.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Settings of a run.
struct ErrorTimeSetting {
  int order = 1;
  Integrator integrator = Integrator::dda;
  bool springs = false;  ///< contact by springs instead of multipliers
  bool incremental = false;
  double time_step = 0.0;
  double accuracy = 0.0;       ///< > 0: the step, or in statics the order, is chosen for it
  double* estimate = nullptr;  ///< receives the estimate of such a run, if not null
};

/// Runs to a time, with a chosen step if the setting has an accuracy, as a run of a scene does. @param time s
/// @return false if a step cannot be taken
[[nodiscard]] bool runs_to(Simulation& simulation, double time, const ErrorTimeSetting& setting);

/// Deflection of clamped_plate() under its weight.
[[nodiscard]] double plate_error(const ErrorTimeSetting& setting);
/// Approach of Hertz's sphere (hertz_sphere.hpp), with the order of the outer blocks, one more near the contact and
/// two more at it; with an accuracy all begin at 1.
[[nodiscard]] double sphere_error(const ErrorTimeSetting& setting);
/// Time in which a rigid block that stands on its edge falls back on its base: a quarter of 1.0954 s.
[[nodiscard]] double rocking_error(const ErrorTimeSetting& setting);
/// Impulse of the impact of meeting_bars(), 80 N s; the step is over the duration 2 L / c of contact.
[[nodiscard]] double bar_impact_error(const ErrorTimeSetting& setting);

}  // namespace ashlar

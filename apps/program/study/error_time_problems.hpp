// Problems of error_time_study.hpp beside its first four: each runs with given or chosen orders or steps.
#pragma once

#include "apps/scene/model/scene_analysis.hpp"
#include "solver/accuracy/static_accuracy.hpp"
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

/// Error of the only value of a goal in equilibrium, infinite without one; with an accuracy the blocks begin with their
/// present orders. @param exact of the goal's unit
[[nodiscard]] double error_in_equilibrium(Simulation simulation, const GoalValues& goal, double exact,
                                          const ErrorTimeSetting& setting);

/// Deflection of clamped_plate() under its weight.
[[nodiscard]] double plate_error(const ErrorTimeSetting& setting);
/// Approach of Hertz's sphere (hertz_sphere.hpp), with the order of the outer blocks, one more near the contact and
/// two more at it; with an accuracy all begin at 1.
[[nodiscard]] double sphere_error(const ErrorTimeSetting& setting);
/// Tip of a clamped cantilever (orders_study.hpp) under its weight, with the static analysis of a run.
[[nodiscard]] double cantilever_error(const ErrorTimeSetting& setting);

/// The crown of a semicircular arch of eight voussoirs under its weight, with friction and springs in its joints. There is no closed form: errors
/// are relative to arch_reference(). A chosen run includes the run afterwards that starts from the voussoirs as placed.
[[nodiscard]] double arch_error(const ErrorTimeSetting& setting);
/// Voussoirs of order 6, with the same contacts, computed by this program.
struct ArchReference {
  double sinking;  ///< of the crown's outer edge, m
  double error;    ///< relative change of order 5 to 6: the reference is not known better
};
[[nodiscard]] ArchReference arch_reference();

/// A horizontal force per mass that rises from 0 to its peak in half of its duration and falls back likewise, on a rigid
/// block that friction holds on a level base.
struct SlidingPulse {
  double peak;      ///< A, m/s^2
  double friction;  ///< f = tan(phi) g, m/s^2, < A
  double duration;  ///< T, s
};
/// Distance at which the block stops, m. With the rate r = 2 A / T it slides from t0 = f / r on. Until T - t0 its velocity
/// rises to v = r h^2 with h = (A - f) / r, by symmetry over r h^3; to the end of the pulse over v t0 - r t0^3 / 6 to
/// w = v - r t0^2 / 2, and then over w^2 / 2f. @pre w >= 0
[[nodiscard]] double slide_of_pulse(const SlidingPulse& pulse);
/// Distance of such a block.
[[nodiscard]] double sliding_error(const ErrorTimeSetting& setting);

/// Time in which a rigid block that stands on its edge falls back on its base: a quarter of 1.0954 s.
[[nodiscard]] double rocking_error(const ErrorTimeSetting& setting);
/// Impulse of the impact of meeting_bars(), 80 N s; the step is over the duration 2 L / c of contact.
[[nodiscard]] double bar_impact_error(const ErrorTimeSetting& setting);

}  // namespace ashlar

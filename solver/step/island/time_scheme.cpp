#include "solver/step/island/time_scheme.hpp"

namespace ashlar {
namespace {

struct NewmarkParameters {
  double beta;
  double gamma;
  double alpha_m;
  double alpha_f;
};

/// Chung and Hulbert's parameters for a spectral radius at infinite frequency.
NewmarkParameters generalized_alpha(double radius) {
  const double alpha_m = (2.0 * radius - 1.0) / (radius + 1.0);
  const double alpha_f = radius / (radius + 1.0);
  const double shift = alpha_f - alpha_m;
  return {0.25 * (1.0 + shift) * (1.0 + shift), 0.5 + shift, alpha_m, alpha_f};
}

TimeScheme newmark_scheme(const NewmarkParameters& p, double step, double damping) {
  TimeScheme scheme;
  scheme.step = step;
  scheme.mass_damping = damping;
  scheme.end_share = 1.0 - p.alpha_f;
  scheme.force_weight = p.gamma / (1.0 - p.alpha_m);
  scheme.acceleration_memory = p.alpha_m;
  scheme.end_velocity = {p.gamma / (p.beta * step), 1.0 - p.gamma / p.beta,
                         step * (1.0 - 0.5 * p.gamma / p.beta)};
  scheme.damped_velocity = {scheme.end_share * scheme.end_velocity.change,
                            scheme.end_share * scheme.end_velocity.velocity + p.alpha_f,
                            scheme.end_share * scheme.end_velocity.acceleration};
  scheme.dashpot_velocity = {1.0 / step, 0.0, 0.0};
  const double bare = p.gamma / (p.beta * step * step);
  const double weighted = scheme.force_weight * damping;
  scheme.inertia = bare + weighted * scheme.damped_velocity.change;
  scheme.free_change.velocity = (bare * step - weighted * scheme.damped_velocity.velocity) / scheme.inertia;
  scheme.free_change.acceleration =
      (bare * step * step * (0.5 - p.beta) - weighted * scheme.damped_velocity.acceleration -
       scheme.force_weight * p.alpha_m) /
      scheme.inertia;
  return scheme;
}

TimeScheme average_acceleration_scheme(double step, double damping) {
  TimeScheme scheme;
  scheme.step = step;
  scheme.mass_damping = damping;
  scheme.end_share = 0.5;
  scheme.mean_contacts = true;
  scheme.end_velocity = {2.0 / step, -1.0, 0.0};
  scheme.damped_velocity = scheme.dashpot_velocity = {1.0 / step, 0.0, 0.0};
  scheme.inertia = 2.0 / (step * step) + damping / step;
  scheme.free_change.velocity = 2.0 / step / scheme.inertia;
  return scheme;
}

}  // namespace

namespace {

TimeScheme undamped_by_stiffness(const SimulationSettings& settings, double step) {
  switch (settings.integrator) {
    case Integrator::dda: {
      TimeScheme scheme = newmark_scheme({0.5, 1.0, 0.0, 0.0}, step, settings.mass_damping);
      scheme.dashpot_velocity = scheme.end_velocity;
      return scheme;
    }
    case Integrator::average_acceleration:
      return average_acceleration_scheme(step, settings.mass_damping);
    case Integrator::generalized_alpha:
      return newmark_scheme(generalized_alpha(settings.spectral_radius), step, settings.mass_damping);
  }
  return {};
}

}  // namespace

TimeScheme time_scheme(const SimulationSettings& settings, double step) {
  TimeScheme scheme = undamped_by_stiffness(settings, step);
  scheme.stiffness_share = settings.stiffness_damping / (scheme.end_share * step);
  return scheme;
}

}  // namespace ashlar

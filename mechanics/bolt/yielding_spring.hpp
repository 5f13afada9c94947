// A spring along one direction that yields, as the gradient of a convex incremental potential:
//
//   x = length change less the plastic part,   l <= k x <= u     elastic: 1/2 k x^2, force k x
//   k x > u: with x_u = u / k   1/2 k x_u^2 + u (x - x_u) + 1/2 h (x - x_u)^2,   force u + h (x - x_u)
//
// and likewise below l. The first term is stored, the others are dissipated once the step is accepted. h = hardening k
// is so small that it does not count beside u, but makes the position of a yielding bar in yielding grout unique; its
// force is not remembered. A side without resistance (slack) has the limit 0 and dissipates nothing.
#pragma once

#include <limits>

namespace ashlar {

/// A spring's constants.
struct YieldingSpring {
  double stiffness = 0.0;                                   ///< k, N/m, >= 0; 0: no spring
  double lower = -std::numeric_limits<double>::infinity();  ///< N, <= 0
  double upper = std::numeric_limits<double>::infinity();   ///< N, >= 0
  bool slack_below = false;  ///< no compression: `lower` is 0 and nothing yields there
  bool slack_above = false;  ///< no tension: `upper` is 0

  /// Share of the stiffness that a yielding spring keeps within a step.
  static constexpr double hardening = 1e-9;
};

/// Response at an elastic length change.
struct SpringPoint {
  double force = 0.0;       ///< N, positive in tension
  double tangent = 0.0;     ///< N/m, >= 0
  double stored = 0.0;      ///< J
  double dissipated = 0.0;  ///< J, >= 0, by the yielding of this step
  double yielded = 0.0;     ///< m, change of the plastic part; 0: elastic or slack
  /// -1 below the lower limit, 1 above the upper one, 0 elastic
  int side = 0;
};

/// @param x length change less the plastic part, m
[[nodiscard]] inline SpringPoint respond(const YieldingSpring& spring, double x) {
  const double k = spring.stiffness;
  const double trial = k * x;
  if (trial >= spring.lower && trial <= spring.upper) return {trial, k, 0.5 * trial * x, 0.0, 0.0, 0};
  const int side = trial > spring.upper ? 1 : -1;
  if (side > 0 ? spring.slack_above : spring.slack_below) return {0.0, 0.0, 0.0, 0.0, 0.0, side};
  const double limit = side > 0 ? spring.upper : spring.lower;
  const double beyond = x - limit / k;
  const double h = YieldingSpring::hardening * k;
  return {limit + h * beyond,
          h,
          0.5 * limit * limit / k,
          limit * beyond + 0.5 * h * beyond * beyond,
          beyond,
          side};
}

}  // namespace ashlar

#include "solver/step/impact/restitution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/impact/closing_speeds.hpp"
#include "solver/step/impact/impact_of_blocks.hpp"

namespace ashlar {
namespace {

/// Predicted time of a touch, of the step, up to which it shortens the step: a later one has missed what turns or bends, and
/// the step is halved.
constexpr double shortens_step = 0.999;

/// When a point is about to touch on free motion, and how fast.
struct FirstTouch {
  double time;   ///< s
  double speed;  ///< of approach, m/s
};

/// Solves  gap + u t + a t^2/2 = 0  for the first t > 0. Empty: never
std::optional<FirstTouch> touch_of(double gap, double velocity, double acceleration) {
  const double square = velocity * velocity - 2.0 * acceleration * gap;
  if (!(square >= 0.0)) return std::nullopt;
  const double speed = std::sqrt(square);
  if (!(speed - velocity > 0.0)) return std::nullopt;
  return FirstTouch{2.0 * gap / (speed - velocity), speed};
}

/// Time of the first impact of a pair in a solved step, s; infinity: none.
double first_impact(const StepProblem& problem, double step, const ContactPair& pair,
                    const ImpactLimits& limits, RigidMotions& motions) {
  double first = std::numeric_limits<double>::infinity();
  const Eigen::RowVectorXd end =
      pair.places(problem.bodies[at(pair.a())].change, problem.bodies[at(pair.b())].change).row(0);
  if (!(end.minCoeff() <= 0.0)) return first;
  Eigen::RowVectorXd velocities, rates;
  for (Eigen::Index k = 0; k < end.size(); ++k) {
    const auto point = static_cast<std::size_t>(k);
    const double gap = pair.start_gap(point);
    if (end[k] > 0.0 || gap <= limits.gap || pair.holds(point)) continue;
    if (velocities.size() == 0) {
      velocities = motions.at_points(pair).row(0);
      rates = motions.accelerations(pair, problem);
    }
    const double distance = gap - 0.5 * limits.gap;
    const FirstTouch straight{step * distance / (gap - end[k]), (gap - end[k]) / step};
    const FirstTouch touch = touch_of(distance, velocities[k], rates[k]).value_or(straight);
    if (touch.speed > limits.speed) first = std::min(first, touch.time);
  }
  return first;
}

}  // namespace

std::optional<double> share_until_impact(const BlockSystem& system, const RunState& state, double step,
                                         const StepProblem& problem) {
  RigidMotions motions(system, state.states);
  const ImpactLimits limits = limits_of(system.settings(), state.time());
  double first = std::numeric_limits<double>::infinity();
  for (const ContactPair& pair : problem.pairs)
    if (pair.restitution()) first = std::min(first, first_impact(problem, step, pair, limits, motions));
  first = least_of_run(system, first);
  if (std::isinf(first)) return std::nullopt;
  return first < shortens_step * step ? first / step : 0.5;
}

bool rebound(const BlockSystem& system, RunState& state, const std::vector<ContactPair>& pairs) {
  ImpactOfBlocks impact(system, state, pairs);
  if (!impact.may_meet() || !impact.find()) return false;
  impact.apply();
  return true;
}

}  // namespace ashlar

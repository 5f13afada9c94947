#include "solver/step/impact/impact.hpp"

#include <algorithm>
#include <cmath>

#include "solver/step/impact/impact_splitting.hpp"
#include "solver/step/impact/proximal_impact.hpp"

namespace ashlar {
namespace {

using Impulses = std::vector<Eigen::Vector3d>;

/// Impulses between two solutions.
Impulses between(const Impulses& first, const Impulses& second, double share) {
  Impulses result;
  for (std::size_t k = 0; k < first.size(); ++k)
    result.emplace_back(first[k] + share * (second[k] - first[k]));
  return result;
}

ImpactResult result_of(const ImpactBodies& bodies, std::size_t count, Impulses impulses, double residual) {
  ImpactResult result;
  const Eigen::VectorXd z = bodies.changes(impulses);
  for (std::size_t body = 0; body < count; ++body) result.changes.push_back(bodies.of_body(body, z));
  result.work = bodies.work(impulses);
  result.impulses = std::move(impulses);
  result.residual = residual;
  return result;
}

/// Impulses as near to the second ones as the energy allows. @param first that gain none
Impulses without_gain(const ImpactBodies& bodies, const Impulses& first, const Impulses& second) {
  double low = 0.0, high = 1.0;
  constexpr int halvings = 60;  // to the last bit
  for (int k = 0; k < halvings; ++k) {
    const double share = 0.5 * (low + high);
    (bodies.work(between(first, second, share)) <= 0.0 ? low : high) = share;
  }
  return between(first, second, low);
}

/// Splitting finds which points stick, slide and part, passes of Newton's method the impulses; a longer search where
/// these do not suffice.
FoundImpulses find_impulses(const ImpactBodies& bodies, const ImpactEffort& effort) {
  constexpr double accuracy = 1e-12;
  constexpr double good = 1e-9;     // orders and orientations of blocks agree to about that
  constexpr double stiffer = 1e-3;  // first compliance of a search that starts nearer
  const Impulses none(bodies.points(), Eigen::Vector3d::Zero());
  if (bodies.residual(none) == 0.0) return {none, 0.0};
  const FoundImpulses near = split_impulses(bodies, accuracy, effort.quick);
  FoundImpulses best = proximal_impulses(bodies, near, {}, accuracy, effort.passes);
  if (best.residual <= good) return best;
  const FoundImpulses nearer = split_impulses(bodies, accuracy, effort.thorough);
  const FoundImpulses other = proximal_impulses(bodies, nearer, {.first = stiffer}, accuracy, effort.passes);
  return other.residual < best.residual ? other : best;
}

/// Work that is rounding, J.
double rounding_of(const std::vector<ImpactPoint>& points, const Impulses& impulses) {
  double speed = 0.0, impulse = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    speed = std::max(speed, points[k].velocity.norm());
    impulse += impulses[k].norm();
  }
  return 1e-12 * impulse * speed;
}

}  // namespace

ImpactResult solve_impact(const std::vector<double>& inertia, const std::vector<int>& sizes,
                          const std::vector<ImpactPoint>& points, const ImpactEffort& effort) {
  const ImpactBodies bodies(inertia, sizes, points);
  FoundImpulses found = find_impulses(bodies, effort);
  if (bodies.work(found.impulses) <= rounding_of(points, found.impulses))
    return result_of(bodies, sizes.size(), std::move(found.impulses), found.residual);
  std::vector<ImpactPoint> plastic = points;
  for (ImpactPoint& point : plastic) point.target = std::min(point.target, 0.0);
  FoundImpulses stopped = find_impulses(ImpactBodies(inertia, sizes, plastic), effort);
  const double residual = std::max(found.residual, stopped.residual);
  // Without rebound only an error of the iteration gains energy: then no impulse is the safe one.
  if (bodies.work(stopped.impulses) > 0.0)
    stopped.impulses =
        without_gain(bodies, Impulses(points.size(), Eigen::Vector3d::Zero()), stopped.impulses);
  return result_of(bodies, sizes.size(), without_gain(bodies, stopped.impulses, found.impulses), residual);
}

}  // namespace ashlar

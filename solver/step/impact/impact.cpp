#include "solver/step/impact/impact.hpp"

#include <algorithm>
#include <cmath>

#include "solver/step/impact/impact_splitting.hpp"
#include "solver/step/impact/proximal_impact.hpp"

namespace ashlar {
namespace {

using Impulses = std::vector<Eigen::Vector3d>;

/// Residual (ImpactResult) that ends a search, and the one that needs no longer search: orders and orientations of blocks
/// agree to about that.
constexpr double sought_residual = 1e-12, good_residual = 1e-9;
/// First compliance of a search that starts nearer to the solution: a larger one would lead away from it.
constexpr double nearer_compliance = 1e-3;
/// Halvings of the share of two solutions: to the last bit.
constexpr int share_halvings = 60;
/// Rounding error of the work of impulses, of their sum times the largest speed: with a smaller one impacts without gain are
/// solved twice, with a larger one energy may grow.
constexpr double work_rounding = 1e-12;

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
  for (int k = 0; k < share_halvings; ++k) {
    const double share = 0.5 * (low + high);
    (bodies.work(between(first, second, share)) <= 0.0 ? low : high) = share;
  }
  return between(first, second, low);
}

/// Splitting finds which points stick, slide and part, passes of Newton's method the impulses; a longer search where
/// these do not suffice.
FoundImpulses find_impulses(const ImpactBodies& bodies, const ImpactEffort& effort) {
  const Impulses none(bodies.points(), Eigen::Vector3d::Zero());
  if (bodies.residual(none) == 0.0) return {none, 0.0};
  const FoundImpulses near = split_impulses(bodies, sought_residual, effort.quick);
  FoundImpulses best = proximal_impulses(bodies, near, {}, sought_residual, effort.passes);
  if (best.residual <= good_residual) return best;
  const FoundImpulses nearer = split_impulses(bodies, sought_residual, effort.thorough);
  const FoundImpulses other =
      proximal_impulses(bodies, nearer, {.first = nearer_compliance}, sought_residual, effort.passes);
  return other.residual < best.residual ? other : best;
}

/// Work that is rounding, J.
double rounding_of(const std::vector<ImpactPoint>& points, const Impulses& impulses) {
  double speed = 0.0, impulse = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    speed = std::max(speed, points[k].velocity.norm());
    impulse += impulses[k].norm();
  }
  return work_rounding * impulse * speed;
}

}  // namespace

ImpactResult solve_impact(const std::vector<double>& inertia, const std::vector<int>& sizes,
                          const std::vector<ImpactPoint>& points, const ImpactEffort& effort) {
  const ImpactBodies bodies(inertia, sizes, points);
  FoundImpulses solution = find_impulses(bodies, effort);
  if (bodies.work(solution.impulses) <= rounding_of(points, solution.impulses))
    return result_of(bodies, sizes.size(), std::move(solution.impulses), solution.residual);
  std::vector<ImpactPoint> plastic = points;
  for (ImpactPoint& point : plastic) point.target = std::min(point.target, 0.0);
  FoundImpulses stopped = find_impulses(ImpactBodies(inertia, sizes, plastic), effort);
  const double residual = std::max(solution.residual, stopped.residual);
  // Without rebound only an error of the iteration gains energy: then no impulse is the safe one.
  if (bodies.work(stopped.impulses) > 0.0)
    stopped.impulses =
        without_gain(bodies, Impulses(points.size(), Eigen::Vector3d::Zero()), stopped.impulses);
  return result_of(bodies, sizes.size(), without_gain(bodies, stopped.impulses, solution.impulses), residual);
}

}  // namespace ashlar

#include "solver/step/impact/closing_speeds.hpp"

#include <algorithm>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"

namespace ashlar {
namespace {

/// Limits of speeds in g dt (notes/restitution.md). Closing: a block that is placed on another one without its weight closes
/// by 1 in its first step; rounding shall not decide whether that is an impact. Rebound: it would end within a step.
constexpr double steps_of_fall = 1.5, steps_of_rise = 0.5;
/// A point on the outline of the compressed part of a joint has no gap: at most this one, of the limit, of which a step that
/// was cut for a touch leaves half. It begins an impact from this share of the fastest closing speed of its blocks on.
constexpr double gap_on_outline = 1e-2, slow_on_outline = 0.5;

/// True if a joint transmits compression at the start of the step.
bool bears(const ContactPair& pair) {
  for (std::size_t k = 0; k < pair.points().size(); ++k)
    if (pair.loaded(k)) return true;
  return false;
}

}  // namespace

ImpactLimits limits_of(const SimulationSettings& settings, double time) {
  const double in_a_step = settings.gravity_at(time).norm() * settings.time_step;
  return {settings.search.passing_share * settings.contact_distance, steps_of_fall * in_a_step,
          steps_of_rise * in_a_step};
}

ClosingSpeeds::ClosingSpeeds(const BlockSystem& system, const std::vector<ContactPair>& pairs,
                             const std::vector<std::size_t>& concerned, const ImpactLimits& limits,
                             RigidMotions& motions)
    : system_(system), limits_(limits), fastest_(system.blocks().size(), 0.0) {
  if (!any_of_run(system, !concerned.empty())) return;
  std::vector<bool> wanted(fastest_.size(), false);
  for (const std::size_t n : concerned)
    for (const int block : {pairs[n].a(), pairs[n].b()}) wanted[at(block)] = system.moving()[at(block)];
  wanted = any_of_run(system, wanted);
  for (const ContactPair& pair : pairs) {
    if (!pair.restitution() || !system.owns_pair(pair.a(), pair.b())) continue;
    if (!wanted[at(pair.a())] && !wanted[at(pair.b())]) continue;
    const Eigen::Matrix3Xd& velocities = motions.at_points(pair);
    for (std::size_t k = 0; k < pair.points().size(); ++k) {
      if (pair.holds(k) || pair.loaded(k)) continue;
      for (const int block : {pair.a(), pair.b()})
        fastest_[at(block)] = std::max(fastest_[at(block)], -velocities(0, static_cast<Eigen::Index>(k)));
    }
  }
  fastest_ = most_of_run(system, fastest_);
}

double ClosingSpeeds::fastest_of(const ContactPair& pair) const {
  double fastest = 0.0;
  for (const int block : {pair.a(), pair.b()})
    if (system_.moving()[at(block)]) fastest = std::max(fastest, fastest_[at(block)]);
  return fastest;
}

bool ClosingSpeeds::begins(const ContactPair& pair, std::size_t point, double velocity) const {
  if (!pair.restitution() || pair.holds(point) || pair.loaded(point) || !(-velocity > limits_.speed))
    return false;
  const double gap = pair.start_gap(point);
  if (gap > limits_.gap) return false;
  return gap > gap_on_outline * limits_.gap || !bears(pair) ||
         -velocity >= slow_on_outline * fastest_of(pair);
}

bool ClosingSpeeds::takes_part(const ContactPair& pair, std::size_t point, double velocity) const {
  const double gap = pair.start_gap(point);
  if (pair.loaded(point) || gap <= limits_.gap) return true;
  if (!(velocity < 0.0)) return false;
  return gap * fastest_of(pair) <= limits_.moment() * -velocity;
}

}  // namespace ashlar

#include "solver/step/solve/augmentation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ashlar {
namespace {

// Deformation of a point's springs over the allowed one: settings.multipliers.share of the tolerance. The allowed
// compression is reduced for points detected at a depth, in proportion to the remaining depth.
double compression_of(const PointLaw& law, const PointResponse& point, double gap,
                      const SimulationSettings& settings) {
  constexpr double least = 0.01;  // of the allowed deformation of a point at the surface
  if (!law.augmented || point.state == ContactState::open) return 0.0;
  const double allowed = settings.multipliers.share * settings.multipliers.penetration_tolerance;
  const double left = std::clamp(1.0 + gap / settings.multipliers.tolerated_depth(), least, 1.0);
  double most = 0.0;
  const auto look_at = [&most](double force, double stiffness, double distance) {
    if (stiffness > 0.0) most = std::max(most, force / (stiffness * distance));
  };
  const double change = point.force[0] - law.normal_multiplier;
  look_at(std::abs(change), law.normal_stiffness, change > 0.0 ? left * allowed : allowed);
  look_at((law.shear_multiplier - point.force.tail<2>()).norm(), law.shear_stiffness, allowed);
  return most;
}

}  // namespace

bool Augmentation::stiffen(IslandProblem& problem) {
  constexpr double margin = 4.0;  // forces grow as springs are stiffened
  constexpr double most = 1e4;    // in one update
  bool stiffer = false;
  for (std::size_t pair = 0; pair < problem.pairs(); ++pair) {
    for (std::size_t k = 0; k < problem.laws()[pair].size(); ++k) {
      PointLaw& law = problem.changing_laws()[pair][k];
      const double gap = problem.pair(pair).points()[k].gap - problem.pair(pair).dilation_before(k);
      const double found = compression_of(law, problem.responses()[pair].points[k], gap, problem.settings());
      if (found <= 1.0) continue;
      stiffer = true;
      const double factor = std::min(margin * found, most);
      law.normal_stiffness *= factor;
      law.shear_stiffness *= factor;
    }
  }
  return stiffer;
}

bool Augmentation::lower_multipliers(IslandProblem& problem) {
  if (problem.scheme().is_static()) return false;
  const MultiplierSettings& multipliers = problem.settings().multipliers;
  const double accuracy = multipliers.accuracy * multipliers.penetration_tolerance;
  bool lowered = false;
  beyond_ *= 2.0;  // 1 the first time
  for (std::size_t pair = 0; pair < problem.pairs(); ++pair) {
    std::vector<PointLaw>& laws = problem.changing_laws()[pair];
    if (laws.empty() || !laws.front().augmented) continue;
    const std::vector<PointResponse>& points = problem.responses()[pair].points;
    double force = 0.0;
    for (const PointResponse& point : points) force += std::max(0.0, point.force[0]);
    if (!(problem.given(pair) - problem.pair(pair).spent() > accuracy * force)) continue;
    for (std::size_t k = 0; k < laws.size(); ++k) {
      const Eigen::Vector2d shear = points[k].force.tail<2>();
      const double fall = std::max(0.0, laws[k].normal_multiplier - points[k].force[0]);
      const double along = std::max(0.0, shear.dot(laws[k].shear_multiplier - shear));
      lowered = lowered || fall > 0.0 || along > 0.0;
      laws[k].normal_multiplier = std::max(0.0, laws[k].normal_multiplier - (1.0 + beyond_) * fall);
      if (along > 0.0) laws[k].shear_multiplier -= (1.0 + beyond_) * along / shear.squaredNorm() * shear;
    }
  }
  return lowered;
}

}  // namespace ashlar

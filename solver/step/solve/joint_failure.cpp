#include "solver/step/solve/joint_failure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ashlar {
namespace {

// A point fails by opening. Its residual cohesion acts from the next step on if it is closed then: in this step its
// shear force would jump with each change of state. A point that yields remains closed.
void open(PointLaw& law) {
  law.fail();
  if (!law.yields()) law.cohesion = 0.0;
}

/// Fails points with cohesion that have opened by more than rounding error. @return true if any has failed
bool open_joints(IslandProblem& problem) {
  bool opened = false;
  for (std::size_t pair = 0; pair < problem.pairs(); ++pair) {
    std::vector<PointLaw>& laws = problem.changing_laws()[pair];
    if (std::none_of(laws.begin(), laws.end(), [](const PointLaw& law) { return law.bridged; })) continue;
    const std::vector<double> gaps = problem.gaps(pair);
    for (std::size_t k = 0; k < laws.size(); ++k) {
      PointLaw& law = laws[k];
      if (!law.bridged || problem.responses()[pair].points[k].tangent(0, 0) > 0.0 ||
          gaps[k] - problem.pair(pair).dilation_before(k) <= problem.settings().tearing_gap())
        continue;
      law.bridged = false;
      open(law);
      opened = true;
    }
  }
  return opened;
}

}  // namespace

JointFailure::JointFailure(IslandProblem& problem) {
  for (auto& laws : problem.changing_laws()) {
    strengths_.emplace_back();
    for (PointLaw& law : laws) {
      strengths_.back().push_back(law.tension);
      // A bond with fracture energy transmits what is left of its strength.
      if (law.bond.tension > 0.0 || law.yields()) continue;
      if (law.tension > 0.0)
        law.tension = std::numeric_limits<double>::infinity();
      else if (law.cohesion > 0.0)
        law.bridged = true;
    }
  }
}

bool JointFailure::break_joints(IslandProblem& problem) const {
  double most = 0.0;
  const auto excess = [&](std::size_t pair, std::size_t point) {
    return std::isinf(problem.laws()[pair][point].tension)
               ? -problem.responses()[pair].points[point].force[0] - strengths_[pair][point]
               : 0.0;
  };
  for (std::size_t pair = 0; pair < strengths_.size(); ++pair) {
    for (std::size_t k = 0; k < strengths_[pair].size(); ++k) most = std::max(most, excess(pair, k));
  }
  most = problem.sums().largest(most);
  if (!(most > 0.0)) return problem.sums().any(open_joints(problem));
  for (std::size_t pair = 0; pair < strengths_.size(); ++pair) {
    for (std::size_t k = 0; k < strengths_[pair].size(); ++k) {
      if (excess(pair, k) < 0.5 * most) continue;
      open(problem.changing_laws()[pair][k]);
    }
  }
  return true;
}

}  // namespace ashlar

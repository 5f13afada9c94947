#include "solver/step/accept/turn_limit.hpp"

#include <algorithm>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"

namespace ashlar {

double turn_between(const Eigen::MatrixX3d& before, const Eigen::MatrixX3d& after) {
  // Coefficients beyond the first are those of zero mean: arms from the centroid.
  const Eigen::Index arms = before.rows() - 1;
  const Eigen::Matrix3d spread = before.bottomRows(arms).transpose() * before.bottomRows(arms);
  const Eigen::Matrix3d moment = before.bottomRows(arms).transpose() * after.bottomRows(arms);
  const Vector3 axial(moment(1, 2) - moment(2, 1), moment(2, 0) - moment(0, 2), moment(0, 1) - moment(1, 0));
  const Eigen::Matrix3d inertia = spread.trace() * Eigen::Matrix3d::Identity() - spread;
  return inertia.ldlt().solve(axial).norm();
}

double limited_by_turns(const BlockSystem& system, RunState& state, double step) {
  if (system.settings().integrator == Integrator::dda) return step;
  double largest = 0.0;
  for (int k = 0; k < system.count(); ++k) {
    const BlockModel& block = system.blocks()[at(k)];
    if (!system.moving()[at(k)] || !system.owns(k) || block.rigid()) continue;
    const BlockState& of = state.states[at(k)];
    largest = std::max(largest, turn_between(of.position, of.position + step * of.velocity));
  }
  largest = most_of_run(system, largest);
  if (!(largest > SimulationSettings::largest_turn)) return step;
  ++state.extremes.turn.limited;
  return step * SimulationSettings::largest_turn / largest;
}

}  // namespace ashlar

#include "apps/results/tables/measure_goals.hpp"

#include <algorithm>
#include <cmath>

namespace ashlar {
namespace {

constexpr double as_good_as_zero = 1e-6;

/// Of any block, root of the mean square, m.
double largest_displacement(const Simulation& simulation) {
  double largest = 0.0;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const PolynomialBasis& basis = simulation.blocks()[k].basis();
    const Eigen::MatrixX3d change = simulation.states()[k].position - basis.identity_map();
    largest = std::max(largest, change.norm() / std::sqrt(basis.volume()));
  }
  return largest;
}

double sum_of_forces(const Simulation& simulation) {
  double sum = 0.0;
  for (const PairRecord& pair : simulation.contacts())
    for (const PointResponse& response : pair.responses) sum += response.force.norm();
  return sum;
}

std::vector<double> values_of(const Simulation& simulation, const Measure& measure) {
  switch (measure.kind) {
    case Measure::Kind::point:
    case Measure::Kind::block: {
      const Vector3 displacement = measured_motion(simulation, measure).displacement;
      return {displacement.x(), displacement.y(), displacement.z()};
    }
    case Measure::Kind::pair: {
      const PairMeasure pair = measured_pair(simulation, measure);
      return {pair.normal_force, pair.shear_force};
    }
    case Measure::Kind::bolt: {
      const BoltMeasure bolt = measured_bolt(simulation, measure);
      return {bolt.axial_force, bolt.shear_force};
    }
    case Measure::Kind::drift: {
      const Vector3 drift = measured_drift(simulation, *measure.levels);
      return {drift.x(), drift.y(), drift.z()};
    }
    case Measure::Kind::crack: {
      const CrackWidths widths = measured_cracks(simulation, *measure.joints);
      return {widths.largest_opening, widths.largest_slip};
    }
    case Measure::Kind::fracture:
      return {};
  }
  return {};
}

/// Velocity of the measured point; empty for others.
std::vector<double> rates_of(const Simulation& simulation, const Measure& measure) {
  if (measure.kind != Measure::Kind::point && measure.kind != Measure::Kind::block) return {};
  const Vector3 velocity = measured_motion(simulation, measure).velocity;
  return {velocity.x(), velocity.y(), velocity.z()};
}

}  // namespace

std::vector<Goal> goals_of(const Simulation& simulation, const std::vector<Measure>& measures) {
  std::vector<Goal> goals;
  goals.reserve(measures.size());
  const double length = as_good_as_zero * largest_displacement(simulation);
  const double force = as_good_as_zero * sum_of_forces(simulation);
  for (const Measure& measure : measures) {
    if (measure.kind == Measure::Kind::fracture) continue;
    const bool is_force = measure.kind == Measure::Kind::pair || measure.kind == Measure::Kind::bolt;
    Goal goal{measure.name, values_of(simulation, measure), is_force ? force : length,
              rates_of(simulation, measure)};
    for (std::vector<double>* values : {&goal.values, &goal.rates})
      for (double& value : *values)
        if (std::isnan(value)) value = 0.0;
    goals.push_back(std::move(goal));
  }
  return goals;
}

}  // namespace ashlar

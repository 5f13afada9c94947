#include "apps/run/answers/shown_state.hpp"

#include <utility>

#include "apps/run/run_group.hpp"
#include "geometry/index.hpp"
#include "solver/run/checkpoint.hpp"

namespace ashlar {
namespace {

/// The simulation's bolts with the forces of a state. Collective.
void set_bolts(const std::vector<BarForce>& forces, const RunGroup& group, Simulation& simulation) {
  if (forces.empty()) return;
  simulation.gather_results();
  SimulationSnapshot snapshot = simulation.snapshot();
  snapshot.run.bolts = bolts_under(forces, simulation.system().bolts(), simulation.bolts());
  simulation.restore(group.value_of_first(snapshot));
}

}  // namespace

BalancedForces balanced_forces(const RigidModel& model, const std::vector<Eigen::Vector3d>& force,
                               const std::vector<bool>& divided, double factor) {
  return {contact_records(model, in_newtons(model, force), divided, factor), bar_forces(model, force)};
}

BalancedForces carried(BalancedForces forces, const std::vector<Eigen::MatrixX3d>& positions,
                       const Simulation& placed) {
  if (positions.empty()) return forces;
  const auto block = [&](int index) { return PlacedBlock(placed.blocks()[at(index)], positions[at(index)]); };
  for (PairRecord& pair : forces.contacts) {
    const PlacedBlock a = block(pair.a), b = block(pair.b);
    for (ContactPoint& point : pair.points) {
      point.place_a = a.place(point.material_a);
      point.place_b = b.place(point.material_b);
    }
  }
  return forces;
}

void show(const ShownState& state, double end_time, const RunGroup& group, Simulation& simulation) {
  simulation.show(state.positions, state.forces.contacts, end_time);
  set_bolts(state.forces.bars, group, simulation);
}

}  // namespace ashlar

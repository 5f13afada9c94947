#include "solver/run/lost_strength.hpp"

#include <limits>

namespace ashlar {
namespace {

/// Calls back with the memory nearest to each point whose joint has strength that fails.
template <class Call>
void for_remembered(const JointLaw& law, const PairHistory& history, const PairRecord& record,
                    const Call& call) {
  for (std::size_t k = 0; k < record.points.size(); ++k) {
    const ContactPoint& point = record.points[k];
    if (!point_law(law, point.area, true).weakens()) continue;
    const PointMemory* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const ContactMemory::Entry& entry : history.memory.entries()) {
      const double distance = (entry.material_b - point.material_b).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      nearest = &entry.memory;
    }
    if (nearest != nullptr) call(k, *nearest);
  }
}

}  // namespace

std::vector<char> points_without_strength(const JointLaw& law, const PairHistory& history,
                                          const PairRecord& record) {
  std::vector<char> lost(record.points.size(), 0);
  for_remembered(law, history, record,
                 [&](std::size_t k, const PointMemory& memory) { lost[k] = memory.intact ? 0 : 1; });
  return lost;
}

double dissipated_energy(const FractureEnergy& fracture, const PointMemory& memory) {
  if (!memory.intact) return fracture.tension;
  return (memory.compression < 0.0 ? fracture.tension : fracture.shear) * memory.damage;
}

std::vector<double> dissipated_energies(const JointLaw& law, const PairHistory& history,
                                        const PairRecord& record) {
  std::vector<double> energies(record.points.size(), 0.0);
  if (law.fracture.given())
    for_remembered(law, history, record, [&](std::size_t k, const PointMemory& memory) {
      energies[k] = dissipated_energy(law.fracture, memory);
    });
  return energies;
}

}  // namespace ashlar

#include "solver/run/lost_strength.hpp"

#include <limits>

namespace ashlar {

std::vector<char> points_without_strength(const JointLaw& law, const PairHistory& history,
                                          const PairRecord& record) {
  std::vector<char> lost(record.points.size(), 0);
  for (std::size_t k = 0; k < lost.size(); ++k) {
    const ContactPoint& point = record.points[k];
    if (!point_law(law, point.area, true).weakens()) continue;
    double least = std::numeric_limits<double>::infinity();
    for (const ContactMemory::Entry& entry : history.memory.entries()) {
      const double distance = (entry.material_b - point.material_b).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      lost[k] = entry.memory.intact ? 0 : 1;
    }
  }
  return lost;
}

}  // namespace ashlar

#include "mechanics/contact_memory.hpp"

#include <limits>

namespace ashlar {

std::vector<PointMemory> ContactMemory::recall(const std::vector<ContactPoint>& points,
                                               double bond_distance) const {
  std::vector<PointMemory> result;
  result.reserve(points.size());
  for (const ContactPoint& point : points) {
    const Entry* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Entry& entry : entries_) {
      if (entry.face_a != point.face_a || entry.face_b != point.face_b) continue;
      const double squared_distance = (entry.material_a - point.material_a).squaredNorm();
      if (squared_distance < least) {
        least = squared_distance;
        nearest = &entry;
      }
    }
    PointMemory memory;
    memory.intact = point.gap <= bond_distance;
    if (nearest != nullptr) {
      memory = nearest->memory;
      const double length = memory.slip.norm();
      memory.slip -= point.normal.dot(memory.slip) * point.normal;
      const double flat = memory.slip.norm();
      if (flat > 0.0) memory.slip *= length / flat;
    }
    result.push_back(memory);
  }
  return result;
}

void ContactMemory::store(const std::vector<ContactPoint>& points, std::vector<PointMemory> memory,
                          double deepest) {
  entries_.clear();
  entries_.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    entries_.push_back({points[k].material_a, points[k].face_a, points[k].face_b, memory[k]});
  }
  deepest_ = deepest;
}

void ContactMemory::carry(const std::function<Vector3(const Vector3&)>& moved) {
  for (Entry& entry : entries_) entry.material_a = moved(entry.material_a);
}

}  // namespace ashlar

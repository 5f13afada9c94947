#include "mechanics/contact_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ashlar {
namespace {

double area_of(const std::vector<ContactMemory::Entry>& entries) {
  return std::accumulate(entries.begin(), entries.end(), 0.0,
                         [](double sum, const ContactMemory::Entry& entry) { return sum + entry.area; });
}

/// A tangential vector in another tangent plane, its length kept.
Vector3 turned(const Vector3& vector, const Vector3& normal) {
  const Vector3 flat = vector - normal.dot(vector) * normal;
  const double length = flat.norm();
  return length > 0.0 ? Vector3(vector.norm() / length * flat) : flat;
}

}  // namespace

ContactMemory::ContactMemory(std::vector<Entry> entries, double deepest, const SpringEnergy& held,
                             double bulge)
    : entries_(std::move(entries)),
      deepest_(deepest),
      bulge_(bulge),
      held_(held),
      squared_reach_(area_of(entries_)) {}

std::optional<PointMemory> ContactMemory::near(const ContactPoint& point, bool same_faces) const {
  constexpr double least_cosine = 0.5;
  // Old points on one place, as on the cut between two cells, are equally far.
  constexpr double blur = 1e-6;
  constexpr double as_near = 1.1;
  const double reach = std::sqrt(squared_reach_);
  std::vector<std::pair<double, const Entry*>> candidates;
  double least = std::numeric_limits<double>::infinity();
  for (const Entry& entry : entries_) {
    if (same_faces ? entry.face_a != point.face_a || entry.face_b != point.face_b
                   : entry.normal.dot(point.normal) < least_cosine)
      continue;
    // One of the two is carried along where a contact slides: the vertex, or the slave's point.
    const double distance =
        std::min((entry.material_a - point.material_a).norm(), (entry.material_b - point.material_b).norm());
    if (distance > reach || distance + blur * reach > as_near * least) continue;
    candidates.emplace_back(distance + blur * reach, &entry);
    least = std::min(least, candidates.back().first);
  }
  if (candidates.empty()) return std::nullopt;
  PointMemory result;
  result.intact = true;
  double sum = 0.0;
  double most = 0.0;
  for (const auto& [distance, entry] : candidates) {
    const double weight = as_near * least - distance;
    if (!(weight > 0.0)) continue;
    const PointMemory& memory = entry->memory;
    if (weight > most) result.state = memory.state;
    most = std::max(most, weight);
    sum += weight;
    result.slip += weight * memory.slip;
    result.compression += weight * memory.compression;
    result.normal_multiplier += weight * memory.normal_multiplier;
    result.shear_multiplier += weight * memory.shear_multiplier;
    result.intact = result.intact && memory.intact;
  }
  result.slip /= sum;
  result.compression /= sum;
  result.normal_multiplier /= sum;
  result.shear_multiplier /= sum;
  return result;
}

std::vector<PointMemory> ContactMemory::recall(const std::vector<ContactPoint>& points,
                                               double bond_distance) const {
  std::vector<PointMemory> result;
  result.reserve(points.size());
  for (const ContactPoint& point : points) {
    PointMemory fresh;
    fresh.intact = point.gap <= bond_distance;
    std::optional<PointMemory> memory = near(point, true);
    const bool same_faces = memory.has_value();
    if (!memory) memory = near(point, false);
    if (memory) {
      memory->slip = turned(memory->slip, point.normal);
      memory->shear_multiplier = turned(memory->shear_multiplier, point.normal);
      memory->intact = memory->intact && same_faces;
    }
    result.push_back(memory.value_or(fresh));
  }
  return result;
}

void ContactMemory::store(const std::vector<ContactPoint>& points, std::vector<PointMemory> memory,
                          double deepest, const SpringEnergy& held, double bulge) {
  entries_.clear();
  entries_.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    entries_.push_back({points[k].material_a, points[k].material_b, points[k].face_a, points[k].face_b,
                        points[k].normal, points[k].area, memory[k]});
  }
  deepest_ = deepest;
  bulge_ = bulge;
  held_ = held;
  squared_reach_ = area_of(entries_);
}

void ContactMemory::carry(bool of_a, const std::function<Vector3(const Vector3&)>& moved) {
  for (Entry& entry : entries_) {
    Vector3& material = of_a ? entry.material_a : entry.material_b;
    material = moved(material);
  }
}

}  // namespace ashlar

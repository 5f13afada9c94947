#include "mechanics/contact/contact_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

namespace ashlar {
namespace {

double largest_area_of(const std::vector<ContactMemory::Entry>& entries) {
  double largest = 0.0;
  for (const ContactMemory::Entry& entry : entries) largest = std::max(largest, entry.area);
  return largest;
}

double area_of_entries(const std::vector<ContactMemory::Entry>& entries) {
  return std::accumulate(entries.begin(), entries.end(), 0.0,
                         [](double sum, const ContactMemory::Entry& entry) { return sum + entry.area; });
}

double most_dilation_of(const std::vector<ContactMemory::Entry>& entries) {
  double most = 0.0;
  for (const ContactMemory::Entry& entry : entries) {
    // A bond in tension transmits forces across its opening.
    const bool bears = entry.memory.intact && entry.memory.state != ContactState::open;
    most = std::max(most, entry.memory.dilation + (bears ? std::max(0.0, -entry.memory.compression) : 0.0));
  }
  return most;
}

/// Directions of friction over two faces.
struct FrictionDirections {
  Vector3 sum = Vector3::Zero();  ///< of unit vectors times areas, m^2
  double area = 0.0;              ///< of points with friction, m^2
  bool all_slide = true;          ///< all closed points
};

std::map<FacePair, FrictionDirections> friction_directions(const std::vector<ContactMemory::Entry>& entries) {
  std::map<FacePair, FrictionDirections> by_faces;
  for (const ContactMemory::Entry& entry : entries) {
    const PointMemory& memory = entry.memory;
    if (memory.state == ContactState::open) continue;
    FrictionDirections& directions = by_faces[{entry.face_a, entry.face_b}];
    directions.all_slide = directions.all_slide && memory.state == ContactState::sliding;
    // For springs the elastic slip is along the force. Multipliers hold the whole force, or replace that of slip.
    const Vector3& along =
        memory.shear_multiplier.squaredNorm() > 0.0 ? memory.shear_multiplier : memory.slip;
    const double length = along.norm();
    if (!(length > 0.0)) continue;
    directions.sum += entry.area / length * along;
    directions.area += entry.area;
  }
  return by_faces;
}

/// Faces with friction torque. @param before in the step before, in order
std::vector<FacePair> turning_faces(const std::vector<ContactMemory::Entry>& entries,
                                    const std::vector<FacePair>& before) {
  constexpr double begins_below = 0.7, ends_at = 0.95;  // of the area
  std::vector<FacePair> turning;
  for (const auto& [faces, directions] : friction_directions(entries)) {
    const double mean = directions.sum.norm();
    const bool turned = std::binary_search(before.begin(), before.end(), faces);
    if (turned ? mean < ends_at * directions.area
               : directions.all_slide && mean < begins_below * directions.area)
      turning.push_back(faces);
  }
  return turning;
}

/// Rotates a tangential vector into another tangent plane with the same length.
Vector3 turned(const Vector3& vector, const Vector3& normal) {
  const Vector3 flat = vector - normal.dot(vector) * normal;
  const double length = flat.norm();
  return length > 0.0 ? Vector3(vector.norm() / length * flat) : flat;
}

}  // namespace

ContactMemory::ContactMemory(std::vector<Entry> entries, std::vector<PressureCut> cuts, double deepest,
                             const SpringEnergy& held, double bulge)
    : entries_(std::move(entries)),
      cuts_(std::move(cuts)),
      deepest_(deepest),
      bulge_(bulge),
      held_(held),
      squared_reach_(area_of_entries(entries_)),
      largest_area_(largest_area_of(entries_)),
      most_dilation_(most_dilation_of(entries_)) {}

ContactMemory::Places ContactMemory::places() const {
  const auto count = static_cast<Eigen::Index>(entries_.size());
  Places places{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    places.of_a.col(k) = entries_[static_cast<std::size_t>(k)].material_a;
    places.of_b.col(k) = entries_[static_cast<std::size_t>(k)].material_b;
  }
  return places;
}

Eigen::RowVectorXd ContactMemory::squared_distances(const ContactPoint& point, const Places& places,
                                                    bool same_faces) const {
  constexpr double least_cosine = 0.5;
  constexpr double too_far = std::numeric_limits<double>::infinity();
  // One of the two moves in the material in sliding: the vertex, or the point opposite to the reference face.
  Eigen::RowVectorXd result =
      (places.of_a.colwise() - point.material_a)
          .colwise()
          .squaredNorm()
          .cwiseMin((places.of_b.colwise() - point.material_b).colwise().squaredNorm());
  constexpr double sliver = 1e-6;  // of the largest area: the place of such points is ill-conditioned
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const Entry& entry = entries_[k];
    const bool other = same_faces ? entry.face_a != point.face_a || entry.face_b != point.face_b
                                  : entry.normal.dot(point.normal) < least_cosine;
    if (other || entry.area < sliver * largest_area_) result[static_cast<Eigen::Index>(k)] = too_far;
  }
  return result;
}

std::optional<ContactMemory::Found> ContactMemory::near(const ContactPoint& point, const Places& places,
                                                        bool same_faces) const {
  if (entries_.empty()) return std::nullopt;
  const Eigen::RowVectorXd distances = squared_distances(point, places, same_faces);
  const double least_squared = distances.minCoeff();
  if (!(least_squared <= squared_reach_)) return std::nullopt;
  // Old points at one place, as on the cut between two cells, are equally far.
  const double blur = 1e-6 * std::sqrt(squared_reach_);
  const double farthest = 1.5 * (std::sqrt(least_squared) + blur) - blur;
  Found found;
  PointMemory& result = found.memory;
  int sources = 0;
  double sum = 0.0;
  double intact = 0.0;
  double in_level = 0.0;
  double most = 0.0;
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const double squared_distance = distances[static_cast<Eigen::Index>(k)];
    if (squared_distance > farthest * farthest) continue;
    // Points without area at one place are equivalent.
    const double weight = farthest > 0.0 ? farthest - std::sqrt(squared_distance) : 1.0;
    const PointMemory& memory = entries_[k].memory;
    found.only_source = ++sources == 1 ? static_cast<int>(k) : -1;
    if (weight > most) result.state = memory.state;
    most = std::max(most, weight);
    sum += weight;
    result.slip += weight * memory.slip;
    if (memory.in_level) {
      result.level_slip += weight * memory.level_slip;
      in_level += weight;
    }
    result.compression += weight * memory.compression;
    result.normal_multiplier += weight * memory.normal_multiplier;
    result.shear_multiplier += weight * memory.shear_multiplier;
    result.deferred_friction += weight * memory.deferred_friction;
    result.dilation += weight * memory.dilation;
    result.level_dilation += weight * memory.level_dilation;
    result.damage += weight * memory.damage;
    result.level_damage += weight * memory.level_damage;
    if (memory.intact) intact += weight;
  }
  // A bond midway between intact and failed ones has failed, independent of rounding.
  result.intact = intact > (0.5 + 1e-6) * sum;
  result.slip /= sum;
  result.in_level = in_level > 0.0;
  if (result.in_level) result.level_slip /= in_level;
  result.compression /= sum;
  result.normal_multiplier /= sum;
  result.shear_multiplier /= sum;
  result.deferred_friction /= sum;
  result.dilation /= sum;
  result.level_dilation /= sum;
  result.damage /= sum;
  result.level_damage /= sum;
  return found;
}

std::vector<PointMemory> ContactMemory::recall(const std::vector<ContactPoint>& points, double bond_distance,
                                               bool keep_forces) const {
  std::vector<PointMemory> result;
  result.reserve(points.size());
  const Places old = places();
  std::vector<int> sources;
  std::vector<int> used(entries_.size(), 0);
  for (const ContactPoint& point : points) {
    PointMemory fresh;
    fresh.intact = point.gap <= bond_distance;
    std::optional<Found> found = near(point, old, true);
    const bool same_faces = found.has_value();
    if (!found) found = near(point, old, false);
    sources.push_back(found ? found->only_source : -1);
    if (sources.back() >= 0) ++used[static_cast<std::size_t>(sources.back())];
    if (!found) {
      result.push_back(fresh);
      continue;
    }
    PointMemory& memory = found->memory;
    memory.slip = turned(memory.slip, point.normal);
    memory.level_slip = turned(memory.level_slip, point.normal);
    memory.shear_multiplier = turned(memory.shear_multiplier, point.normal);
    memory.intact = memory.intact && same_faces;
    result.push_back(memory);
  }
  for (std::size_t k = 0; keep_forces && k < points.size(); ++k) {
    if (sources[k] < 0 || used[static_cast<std::size_t>(sources[k])] != 1 || points[k].area == 0.0) continue;
    const double ratio = entries_[static_cast<std::size_t>(sources[k])].area / points[k].area;
    result[k].normal_multiplier *= ratio;
    result[k].shear_multiplier *= ratio;
  }
  return result;
}

std::vector<PointMemory> ContactMemory::of_same(const std::vector<ContactPoint>& points) const {
  if (points.size() != entries_.size()) throw std::logic_error("memory belongs to other points");
  std::vector<PointMemory> result;
  result.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    PointMemory& memory = result.emplace_back(entries_[k].memory);
    if (points[k].normal == entries_[k].normal) continue;
    for (Vector3* vector : {&memory.slip, &memory.level_slip, &memory.shear_multiplier})
      *vector = turned(*vector, points[k].normal);
  }
  return result;
}

void ContactMemory::store(const std::vector<ContactPoint>& points, std::vector<PointMemory> memory,
                          double deepest, const SpringEnergy& held, double bulge,
                          std::vector<PressureCut> cuts, const std::vector<FacePair>& turned) {
  entries_.clear();
  entries_.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    entries_.push_back({points[k].material_a, points[k].material_b, points[k].face_a, points[k].face_b,
                        points[k].normal, points[k].area, memory[k]});
  }
  cuts_ = std::move(cuts);
  turning_ = turning_faces(entries_, turned);
  deepest_ = deepest;
  bulge_ = bulge;
  held_ = held;
  squared_reach_ = area_of_entries(entries_);
  largest_area_ = largest_area_of(entries_);
  most_dilation_ = most_dilation_of(entries_);
}

void ContactMemory::drop_multipliers() {
  for (Entry& entry : entries_) {
    entry.memory.normal_multiplier = 0.0;
    entry.memory.shear_multiplier.setZero();
  }
}

void ContactMemory::start_level() {
  for (Entry& entry : entries_) {
    entry.memory.level_slip = entry.memory.slip;
    entry.memory.level_dilation = entry.memory.dilation;
    entry.memory.level_damage = entry.memory.damage;
    entry.memory.in_level = entry.memory.state != ContactState::open;
  }
}

void ContactMemory::carry(bool of_a, const std::function<Vector3(const Vector3&)>& moved) {
  for (Entry& entry : entries_) {
    Vector3& material = of_a ? entry.material_a : entry.material_b;
    material = moved(material);
  }
  for (PressureCut& cut : cuts_) {
    if (cut.of_a != of_a) continue;
    cut.start = moved(cut.start);
    cut.end = moved(cut.end);
  }
}

}  // namespace ashlar

#include "mechanics/contact_memory.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
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

Eigen::VectorXd ContactMemory::shares_of(const ContactPoint& point,
                                         const std::vector<Neighbour>& neighbours) {
  // Weights fall to zero at twice the distance of the third point, so that none comes or goes at once.
  const bool limited = neighbours.size() > 3;
  const double squared_radius = 4.0 * (limited ? neighbours[2] : neighbours.back()).squared_distance;
  std::size_t count = 0;
  while (count < neighbours.size() && neighbours[count].squared_distance < squared_radius) ++count;
  const auto rows = static_cast<Eigen::Index>(count);
  Eigen::VectorXd weights(rows);
  Eigen::MatrixXd fields(rows, 4);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const Neighbour& other = neighbours[static_cast<std::size_t>(k)];
    weights[k] = squared_radius / other.squared_distance - 1.0;
    fields.row(k) << 1.0,
        (other.entry->material_a - point.material_a).transpose() / std::sqrt(squared_radius);
  }
  // Square roots of the weights of the squares, (1/d^2 - 1/R^2)^2.
  const Eigen::MatrixXd weighted = weights.asDiagonal() * fields;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> fit(weighted.rows(), weighted.cols());
  fit.setThreshold(1e-6);
  fit.compute(weighted);
  const Eigen::VectorXd shares = (fit.pseudoInverse().row(0).transpose().array() * weights.array()).matrix();
  // Points outside of what is known are not extrapolated far.
  if (shares.cwiseAbs().sum() <= 2.0) return shares;
  const Eigen::VectorXd squares = weights.cwiseAbs2();
  return squares / squares.sum();
}

ContactMemory::ContactMemory(std::vector<Entry> entries, double deepest, const SpringEnergy& held,
                             double bulge)
    : entries_(std::move(entries)),
      deepest_(deepest),
      bulge_(bulge),
      held_(held),
      squared_reach_(area_of(entries_)) {}

std::vector<ContactMemory::Neighbour> ContactMemory::neighbours(const ContactPoint& point,
                                                                bool same_faces) const {
  constexpr double least_cosine = 0.5;
  std::vector<Neighbour> found;
  for (const Entry& entry : entries_) {
    if (same_faces ? entry.face_a != point.face_a || entry.face_b != point.face_b
                   : entry.normal.dot(point.normal) < least_cosine)
      continue;
    // One of the two is carried along where a contact slides: the vertex, or the slave's point.
    const double squared_distance = std::min((entry.material_a - point.material_a).squaredNorm(),
                                             (entry.material_b - point.material_b).squaredNorm());
    if (squared_distance <= squared_reach_) found.push_back({&entry, squared_distance});
  }
  std::stable_sort(found.begin(), found.end(), [](const Neighbour& x, const Neighbour& y) {
    return x.squared_distance < y.squared_distance;
  });
  return found;
}

PointMemory ContactMemory::interpolated(const ContactPoint& point,
                                        const std::vector<Neighbour>& neighbours) const {
  PointMemory memory = neighbours.front().entry->memory;
  constexpr double same_place = 1e-18;
  if (neighbours.size() == 1 || neighbours.front().squared_distance <= same_place * squared_reach_)
    return memory;
  const Eigen::VectorXd shares = shares_of(point, neighbours);
  memory.slip.setZero();
  memory.compression = 0.0;
  memory.normal_multiplier = 0.0;
  memory.shear_multiplier.setZero();
  double intact = 0.0;
  for (Eigen::Index k = 0; k < shares.size(); ++k) {
    const PointMemory& old = neighbours[static_cast<std::size_t>(k)].entry->memory;
    memory.slip += shares[k] * old.slip;
    memory.compression += shares[k] * old.compression;
    memory.normal_multiplier += shares[k] * old.normal_multiplier;
    memory.shear_multiplier += shares[k] * old.shear_multiplier;
    intact += old.intact ? shares[k] : 0.0;
  }
  // Halves are no majority, however they are rounded.
  memory.intact = intact > 0.5 + 1e-6;
  return memory;
}

std::vector<PointMemory> ContactMemory::recall(const std::vector<ContactPoint>& points,
                                               double bond_distance) const {
  std::vector<PointMemory> result;
  result.reserve(points.size());
  for (const ContactPoint& point : points) {
    PointMemory memory;
    memory.intact = point.gap <= bond_distance;
    std::vector<Neighbour> around = neighbours(point, true);
    const bool same_faces = !around.empty();
    if (!same_faces) around = neighbours(point, false);
    if (!around.empty()) {
      memory = interpolated(point, around);
      memory.slip = turned(memory.slip, point.normal);
      memory.shear_multiplier = turned(memory.shear_multiplier, point.normal);
      memory.intact = memory.intact && same_faces;
    }
    result.push_back(memory);
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

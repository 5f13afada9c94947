#include "solver/seams.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ashlar {
namespace {

/// A way across a normal: within 30 degrees of the contact's own plane.
bool across(const Vector3& way, const Vector3& normal) {
  return std::abs(way.dot(normal)) <= 0.5 * way.norm();
}

/// Whether overlaps are no wider than a way is long.
bool undoes(const Vector3& way, const CellOverlap& overlap) {
  if (!across(way, overlap.frame.w)) return false;
  const Eigen::Vector2d direction = Eigen::Vector2d(way.dot(overlap.frame.e1), way.dot(overlap.frame.e2));
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const OverlapCorner& corner : overlap.corners) {
    const double along = corner.place.dot(direction);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  return high - low <= direction.squaredNorm();
}

/// Whether a vertex that moves along a way is no longer over the cell.
bool undoes(const Vector3& way, const PlacedSurface& a, const PlacedSurface& b,
            const VertexContact& contact) {
  const PlacedSurface& with_cell = contact.vertex_of_a ? b : a;
  const Vector3& normal = with_cell.normal(contact.cell);
  if (!across(way, normal)) return false;
  const Vector3 vertex =
      (contact.vertex_of_a ? a : b).point(contact.point) + (contact.vertex_of_a ? way : -way);
  const auto corners = with_cell.corners(contact.cell);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector3 side = corners[(k + 1) % corners.size()] - corners[k];
    if (side.cross(Vector3(vertex - corners[k])).dot(normal) < 0.0) return true;
  }
  return false;
}

/// Whether the lines of two edges, one of them moved along a way, cross off one of the edges.
bool undoes(const Vector3& way, const PlacedSurface& a, const PlacedSurface& b, const EdgeContact& contact) {
  if (!across(way, contact.normal)) return false;
  const ViewFrame frame(Vector3::Zero(), contact.normal);
  const auto ends = [&](const PlacedSurface& s, const CrossedSide& side) {
    return std::array{frame.project(s.point(side.ends[0])), frame.project(s.point(side.ends[1]))};
  };
  auto of_a = ends(a, contact.of_a);
  for (Eigen::Vector2d& end : of_a) end += frame.project(way);
  const auto of_b = ends(b, contact.of_b);
  Eigen::Matrix2d lines;
  lines << of_a[1] - of_a[0], of_b[0] - of_b[1];
  const Eigen::Vector2d shares = lines.inverse() * (of_b[0] - of_a[0]);
  return (shares.array() < 0.0).any() || (shares.array() > 1.0).any();
}

}  // namespace

WaysOut::WaysOut(const std::map<std::array<int, 2>, ContactMemory>& memory) {
  // Directions that differ by less than a third of a degree are one way.
  constexpr double same_direction = 0.99998;
  const auto add = [&](int block, const Vector3& normal, double depth) {
    std::vector<Vector3>& known = ways_[block];
    const bool there = std::any_of(known.begin(), known.end(), [&](const Vector3& way) {
      return way.dot(normal) >= same_direction * way.norm() && way.norm() >= 2.0 * depth;
    });
    if (!there) known.push_back(2.0 * depth * normal);
  };
  for (const auto& [blocks, pair] : memory) {
    if (!(pair.deepest() > 0.0)) continue;
    for (const ContactMemory::Entry& entry : pair.entries()) {
      if (entry.memory.state == ContactState::open) continue;
      add(blocks[0], entry.normal, pair.deepest());
      add(blocks[1], -entry.normal, pair.deepest());
    }
  }
}

std::vector<Vector3> WaysOut::of_pair(int a, int b) const {
  std::vector<Vector3> ways;
  if (const auto known = ways_.find(a); known != ways_.end()) ways = known->second;
  if (const auto known = ways_.find(b); known != ways_.end())
    for (const Vector3& way : known->second) ways.push_back(-way);
  return ways;
}

void leave_out_seams(const PlacedSurface& a, const PlacedSurface& b, const std::vector<Vector3>& ways,
                     PairContacts& contacts) {
  for (const Vector3& way : ways) {
    std::erase_if(contacts.overlaps, [&](const CellOverlap& overlap) { return undoes(way, overlap); });
    std::erase_if(contacts.vertices,
                  [&](const VertexContact& contact) { return undoes(way, a, b, contact); });
    std::erase_if(contacts.edges, [&](const EdgeContact& contact) { return undoes(way, a, b, contact); });
  }
}

bool at_seam(const PlacedSurface& a, const PlacedSurface& b, const std::vector<Vector3>& ways,
             const Touch& touch) {
  return std::any_of(ways.begin(), ways.end(), [&](const Vector3& way) {
    return std::visit([&](const auto& contact) { return undoes(way, a, b, contact); }, touch.contact);
  });
}

}  // namespace ashlar

// What contact points remember from step to step: elastic slip, state and whether the joint is still intact.
// Memory belongs to material points, not to the step's polygons: a new point takes over from the nearest old
// one between the same faces.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "mechanics/contact_points.hpp"
#include "mechanics/joint_law.hpp"

namespace ashlar {

/// Memory of one point after an accepted step.
struct PointMemory {
  Vector3 slip = Vector3::Zero();  ///< elastic slip of a relative to b, in the tangent plane, m
  ContactState state = ContactState::open;
  bool intact = false;  ///< joint strength not yet lost
};

/// Memory of a pair of blocks.
class ContactMemory {
 public:
  /// One remembered point: where it is in block a's material and the faces it is between.
  struct Entry {
    Vector3 material_a;
    int face_a;
    int face_b;
    PointMemory memory;
  };

  ContactMemory() = default;
  /// As `entries` and `deepest` of an earlier one.
  ContactMemory(std::vector<Entry> entries, double deepest)
      : entries_(std::move(entries)), deepest_(deepest) {}

  /// Memory for each of the new points: that of the nearest old point of the same faces, with the slip turned
  /// into the new tangent plane; points without one start open, bonded by the joint's strength if their gap
  /// is at most `bond_distance`, m (minus infinity: never).
  [[nodiscard]] std::vector<PointMemory> recall(const std::vector<ContactPoint>& points,
                                                double bond_distance) const;

  /// Replaces what is remembered. @param deepest largest penetration of the step, m
  void store(const std::vector<ContactPoint>& points, std::vector<PointMemory> memory, double deepest);

  /// Moves the remembered points of block a, whose material coordinates are those of a step's start.
  void carry(const std::function<Vector3(const Vector3&)>& moved);

  /// Largest penetration of the last step, m, >= 0.
  [[nodiscard]] double deepest() const { return deepest_; }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
  double deepest_ = 0.0;
};

}  // namespace ashlar

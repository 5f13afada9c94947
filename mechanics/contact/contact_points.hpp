// From contacts to contact points: every contact becomes point-to-face contacts, a material point of block a
// and one of block b with the outward unit normal of b's surface between them (theory.md sections 6.4, 6.5
// and 7).
//
// Per area, the points of a face-face contact are a quadrature rule on the overlap of each pair of cells, one
// on each of its parts where it is in part open (pressure_end.hpp; not where flat sub-faces stand for blocks
// that bend, nor with multipliers). Per point (the paper's springs) they are the vertices of the faces'
// overlap polygon (overlap_vertices.hpp). Isolated vertices and edge crossings carry a tributary area.
//
// With curved surfaces, the point on the master block is the closest one on its true polynomial surface, so
// that x_a - x_b is along the normal; with flat surfaces both points stay on their sub-face planes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/contacts/contact_search.hpp"
#include "geometry/contacts/overlap_vertices.hpp"
#include "mechanics/contact/contact_kinematics.hpp"
#include "mechanics/contact/joint_law.hpp"
#include "mechanics/contact/pressure_end.hpp"

namespace ashlar {

/// A block with its surface and its present state.
struct ContactBody {
  const BlockModel* model;
  const BlockState* state;
  const PlacedSurface* placed;
  const PlacedBlock* configuration = nullptr;  ///< of the state; contact_points() sets it
};

/// How contact points are made.
struct ContactPointSettings {
  bool area_springs = true;
  bool curved = true;
  /// Multipliers leave next to no gap where they press, which then does not tell where pressure ends.
  bool multipliers = false;
  double known_overlap = 0.0;  ///< m, >= 0: points that were placed so deep start without force
};

/// A face of a, then one of b.
using FacePair = std::array<int, 2>;

/// An overlap whose points are those of area springs, and what it takes to tell where its pressure ends.
struct RuledOverlap {
  std::vector<Eigen::Vector2d> outline;  ///< seen in the overlap's frame
  int degree = 0;                        ///< of its rule, see rule_of()
  std::size_t first = 0;                 ///< its first point among those of the pair
  std::size_t count = 0;                 ///< of the rule on all of it
  std::optional<PressureEnd> end;        ///< where it is cut
  std::vector<ContactPoint> whole;       ///< of the rule on all of it, if it is cut; else they are the pair's
};

/// The rule of a part of an overlap. @param degree 1: affine gaps of affine blocks (affine_rule()); 2 and more: of the
/// functions that polygon_rule() integrates
[[nodiscard]] PolygonRule rule_of(const std::vector<Eigen::Vector2d>& outline, int degree);

/// Whether pressure ends where it did when the points were made, or nowhere inside as then.
/// @param gaps of the rule on all of the overlap, m. @param tolerance m, gaps within it count as 0
[[nodiscard]] bool pressure_ends_as_before(const RuledOverlap& overlap, const std::vector<double>& gaps,
                                           double tolerance);

/// Of a pair of blocks.
struct ContactPoints {
  std::vector<ContactPoint> points;
  std::vector<PressureCut> cuts;       ///< of overlaps that are in part open
  std::vector<RuledOverlap> overlaps;  ///< where cuts are looked for, others are left out
  std::vector<FacePair> turning;       ///< as they were made for, see contact_points()
};

/// All contact points of a pair, in a fixed order. @param references_on_a whether a is the master, on whose surface
/// feet and normals are taken, in each of the overlaps (reference_face.hpp). @param known cuts of the step
/// before
/// @param turning faces over which friction turned in the step before (ContactMemory::turning): their rules are finer
[[nodiscard]] ContactPoints contact_points(const ContactBody& a, const ContactBody& b,
                                           const PairContacts& contacts,
                                           const std::vector<bool>& references_on_a,
                                           const ContactPointSettings& settings,
                                           const std::vector<PressureCut>& known,
                                           const std::vector<FacePair>& turning = {});

}  // namespace ashlar

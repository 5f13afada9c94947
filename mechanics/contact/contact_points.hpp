// From contacts to contact points: every contact becomes point-to-face contacts between a material point of block a
// and one of block b, with the outward unit normal of b's surface (theory.md sections 6.4, 6.5 and 7).
//
// Per area, the points of a face-face contact are a quadrature rule on the overlap of each pair of cells. If the
// overlap is partly open, each of its two parts has a rule (pressure_end.hpp), except for flat sub-faces of blocks
// that bend, and for multipliers. Per point (the paper's springs) they are the vertices of the faces' overlap polygon
// (overlap_vertices.hpp). Isolated vertices and edge crossings have a tributary area.
//
// With curved surfaces, the point on the reference block is the closest one on its true polynomial surface, so that
// x_a - x_b is along the normal. With flat surfaces both points stay on their sub-face planes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/contacts/contact_search.hpp"
#include "geometry/contacts/overlap_vertices.hpp"
#include "mechanics/contact/contact_kinematics.hpp"
#include "mechanics/contact/laws/normal_spring.hpp"
#include "mechanics/contact/pressure_end.hpp"

namespace ashlar {

/// A block with its surface and its present state.
struct ContactBody {
  const BlockModel* model;
  const BlockState* state;
  const PlacedSurface* placed;
  const PlacedBlock* configuration = nullptr;  ///< of the state; set by contact_points()
};

/// How contact points are made.
struct ContactPointSettings {
  bool area_springs = true;
  bool curved = true;
  /// Multipliers leave almost no gap under pressure, so that gaps do not show where pressure ends.
  bool multipliers = false;
  double known_overlap = 0.0;  ///< m, >= 0: points with this initial overlap start without force
  /// Per area: where a joint is closed unevenly, rules are as fine as its curve needs.
  NormalSpring spring = {};
};

/// A face of a, then one of b.
using FacePair = std::array<int, 2>;

/// An overlap with points of area springs, and the data that determine the end of its pressure.
struct RuledOverlap {
  std::vector<Eigen::Vector2d> outline;  ///< in the overlap's frame
  int degree = 0;                        ///< of its rule, see rule_of()
  std::size_t first = 0;                 ///< its first point among those of the pair
  std::size_t count = 0;                 ///< of the rule on the whole overlap
  std::optional<PressureEnd> end;        ///< if it is cut
  std::vector<ContactPoint> whole;       ///< of the rule on the whole overlap, if it is cut; else they are
                                         ///< the pair's
};

/// The rule of a part of an overlap. @param degree 1: affine gaps of affine blocks (affine_rule()); 2 and more:
/// degree of polygon_rule()
[[nodiscard]] PolygonRule rule_of(const std::vector<Eigen::Vector2d>& outline, int degree);

/// True if the end of pressure is unchanged since the points were made, or pressure still does not end inside, and the rule is
/// fine enough.
/// @param gaps of the rule on the whole overlap, m. @param tolerance m, smaller gaps count as 0
/// @param spring as ContactPointSettings
[[nodiscard]] bool rule_lasts(const RuledOverlap& overlap, const std::vector<double>& gaps, double tolerance,
                              const NormalSpring& spring);

/// Contact points of a pair of blocks.
struct ContactPoints {
  std::vector<ContactPoint> points;
  std::vector<PressureCut> cuts;       ///< of partly open overlaps
  std::vector<RuledOverlap> overlaps;  ///< overlaps examined for cuts
  std::vector<FacePair> turning;       ///< argument of contact_points()
};

/// All contact points of a pair, in a fixed order. @param references_on_a by overlap, true if a has the reference
/// face, on which feet and normals are (reference_face.hpp). @param known cuts of the step before
/// @param turning faces with friction torque in the step before (ContactMemory::turning): their rules are finer
[[nodiscard]] ContactPoints contact_points(const ContactBody& a, const ContactBody& b,
                                           const PairContacts& contacts,
                                           const std::vector<bool>& references_on_a,
                                           const ContactPointSettings& settings,
                                           const std::vector<PressureCut>& known,
                                           const std::vector<FacePair>& turning = {});

}  // namespace ashlar

// The contacts of two convex blocks whose faces stay flat, with history.
//
// The features that meet are found one by one (contact_search.hpp): all that a step may bring together. What
// they do not fix is decided by the classifier that `ashlar contacts` prints (convex_contact.hpp), with the
// facet of D = P - Q that was last seen with a positive gap as history: through which of two faces beside
// each other a corner has entered, and the contact of blocks that cross although no two features of theirs
// face each other: a corner on a corner or an edge, edges along each other.
#pragma once

#include <optional>
#include <vector>

#include "geometry/contacts/contact_search.hpp"
#include "geometry/convex/convex_contact.hpp"

namespace ashlar {

/// A facet of D = P - Q (Entrance) by names that outlast a step: where blocks move, rounding changes which
/// facets and edges their hulls have.
struct EntranceName {
  EntranceKind kind = EntranceKind::face_of_a;
  std::array<int, 2> a = {-1, -1};  ///< edge: points of the surface; facet: a cell and -1
  std::array<int, 2> b = {-1, -1};
  bool reversed = false;

  friend bool operator==(const EntranceName&, const EntranceName&) = default;
};

/// A placed surface with the exact convex hull of its points. Constant after construction.
class ConvexSurface {
 public:
  /// @param surface of a convex solid, its faces undivided; must outlive this
  /// @throws std::invalid_argument if the points are coplanar or not finite.
  explicit ConvexSurface(const PlacedSurface& surface);

  [[nodiscard]] const PlacedSurface& placed() const { return *placed_; }
  /// Its corners are points of the surface (source_points).
  [[nodiscard]] const ConvexShape& shape() const { return shape_; }
  /// The cell that has most points in common with a facet, and the reverse: a facet is a cell, part of one or
  /// several of them that are flat together, but for what rounding has bent.
  [[nodiscard]] int cell_of_facet(int facet) const;
  [[nodiscard]] int facet_of_cell(int cell) const;
  /// The edge between two points, -1: none now. @param reversed set if the edge runs the other way
  [[nodiscard]] int find_edge(const std::array<int, 2>& points, bool& reversed) const;

 private:
  [[nodiscard]] std::vector<int> points_of_facet(int facet) const;

  const PlacedSurface* placed_;
  ConvexShape shape_;
};

/// What is known of a pair from the last search.
struct ContactHistory {
  std::optional<EntranceName> entrance;
  /// m: blocks that are deeper in each other along it have not met through it
  double depth = 0.0;
  /// m, >= 0, what gaps may be by rounding of coordinates: blocks nearer to touching than this, without
  /// features that face each other, as diagonal neighbours in a grid, do not bear on each other yet, and
  /// through which facet they will meet is not known
  double rounding = 0.0;
};

/// Completes the contacts that a search found (contact_search.hpp), with no faces over each other, by what
/// the exact contact of the hulls says; sets their type to that of the hulls (crossing: along the direction
/// taken). Where blocks cross along the normal of a face of one, a corner of the other that is on an edge or
/// a corner is held by this face alone, the one it came through: all other contacts of the pair are dropped.
/// @param history of the same pair in the same order
/// @return what the next search of this pair takes as history: of a pair that is apart or just touches the
/// facet of D it is farthest across, of one that crosses the facet that decided
[[nodiscard]] std::optional<EntranceName> settle_convex_contacts(const ConvexSurface& a,
                                                                 const ConvexSurface& b,
                                                                 const ContactHistory& history,
                                                                 PairContacts& contacts);

/// The same of faces over each other, which leave nothing open.
[[nodiscard]] EntranceName entrance_of_faces(const CellOverlap& overlap);

}  // namespace ashlar

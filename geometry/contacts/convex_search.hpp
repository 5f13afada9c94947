// The contacts of two convex blocks whose faces stay flat, with history.
//
// The features in contact are found one by one (contact_search.hpp): all that a step may bring into contact. Cases
// not determined by these are decided by the classifier of `ashlar contacts` (convex_contact.hpp), with the facet of
// D = P - Q that last had a positive gap as history: the face of two adjacent ones through which a corner has
// entered, and the contact of crossing blocks without features that face each other, such as a corner on a corner or
// an edge, or collinear edges.
#pragma once

#include <optional>
#include <vector>

#include "geometry/contacts/contact_search.hpp"
#include "geometry/convex/convex_contact.hpp"

namespace ashlar {

/// A facet of D = P - Q (Entrance) with names that are stable between steps: when blocks move, rounding changes the
/// facets and edges of their hulls.
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
  /// The cell with most points in common with a facet, and the reverse: a facet is a cell, part of one, or several
  /// cells that are coplanar but for rounding.
  [[nodiscard]] int cell_of_facet(int facet) const;
  [[nodiscard]] int facet_of_cell(int cell) const;
  /// The edge between two points, -1: none at present. @param reversed set if the edge runs the other way
  [[nodiscard]] int find_edge(const std::array<int, 2>& points, bool& reversed) const;

 private:
  [[nodiscard]] std::vector<int> points_of_facet(int facet) const;

  const PlacedSurface* placed_;
  ConvexShape shape_;
};

/// History of a pair from the last search.
struct ContactHistory {
  std::optional<EntranceName> entrance;
  /// m: blocks that are deeper along the entrance have not entered through it
  double depth = 0.0;
  /// m, >= 0, rounding error of gaps. Blocks closer to touching than this without features that face each other, such
  /// as diagonal neighbours in a grid, do not transmit forces yet, and the facet of entrance is not known
  double rounding = 0.0;
};

/// Completes the contacts of a search (contact_search.hpp) without overlaps of faces by the exact contact of the
/// hulls; sets their type to that of the hulls (crossing: along the selected direction). If blocks cross along the
/// normal of a face of one, a corner of the other that is on an edge or a corner is assigned to this face alone, the
/// one of entrance: all other contacts of the pair are removed.
/// @param history of the same pair in the same order
/// @return history for the next search of this pair: if apart or just touching, the facet of D with the largest
/// separation; if crossing, the deciding facet
[[nodiscard]] std::optional<EntranceName> settle_convex_contacts(const ConvexSurface& a,
                                                                 const ConvexSurface& b,
                                                                 const ContactHistory& history,
                                                                 PairContacts& contacts);

/// The same for overlaps of faces, which are unambiguous.
[[nodiscard]] EntranceName entrance_of_faces(const CellOverlap& overlap);

}  // namespace ashlar

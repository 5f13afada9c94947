// Finds the contacts of two blocks at their current positions, for the mechanics layer (theory.md section 6).
//
// Faces that face each other within the contact angle meet as face-face: the overlap polygons of their cells,
// which hold all vertex-face, edge-face and crossing points in their closure. Beyond that angle a vertex of
// one block meets a face of the other (vertex-face; both ends of an edge that lies within the angle:
// edge-face), and two edges meet where they cross (edge-edge). A vertex over an edge or a vertex is given the
// one face it has entered least. The first block is called a, the second b; normals point out of b, towards
// a.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/contact_type.hpp"
#include "geometry/contacts/cell_overlap.hpp"

namespace ashlar {

/// What counts as a contact. The comparison with each limit is the user's resolution, never hidden elsewhere.
struct ContactLimits {
  double reach = 0.0;        ///< m, largest gap, beyond the chord bounds of curved cells
  double penetration = 0.0;  ///< m, deepest entrance that is still taken as one through this face
  double angle = 0.0;        ///< rad, how far two faces may be from parallel to meet as face-face, 0 to pi/4
  /// m, no contact is deeper, however coarse its cells are: beyond that, faces may look at each other from
  /// the far sides of both blocks
  double deepest = std::numeric_limits<double>::infinity();
};

/// A point of one block's surface over a cell of the other.
struct VertexContact {
  bool vertex_of_a;  ///< true: point of a over a cell of b
  int point;         ///< index into SubFaceSurface::points of its block
  int own_cell;      ///< a cell around it
  int cell;          ///< of the other block
  double gap;        ///< m, along the cell's normal
  double area;       ///< tributary area of the vertex, m^2
};

/// A side of a cell in an edge contact.
struct CrossedSide {
  std::array<int, 2> ends;  ///< points of its block's surface
  int cell;                 ///< a cell that has the side
  double along;             ///< place of the crossing, 0 to 1 from the first end
};

/// Two edges crossing.
struct EdgeContact {
  CrossedSide of_a;
  CrossedSide of_b;
  Vector3 normal;  ///< unit, across both edges, out of b
  double gap;      ///< m
  double area;     ///< tributary area, m^2
};

/// All contacts of a pair of blocks.
struct PairContacts {
  std::vector<CellOverlap> overlaps;
  std::vector<VertexContact> vertices;
  std::vector<EdgeContact> edges;
  /// Of two convex solids as a whole (convex_search.hpp).
  std::optional<ContactType> type;
  DecisionCounts counts;
  [[nodiscard]] bool empty() const { return overlaps.empty() && vertices.empty() && edges.empty(); }
};

/// Mean over the faces around some cells of the area that falls to one corner of each, m^2.
[[nodiscard]] double tributary_area(const SubFaceSurface& surface, const std::vector<int>& cells);

/// Places of a pair's faces that lie on a third block: no way leads in or out there, but through that block.
struct OccludedPlaces {
  using Hides = std::function<bool(int face, const Vector3& place)>;
  Hides of_a;
  Hides of_b;
};

/// Finds every contact of two blocks. The answer is symmetric: swapping a and b swaps their roles in it.
/// @param hidden of a vertex in a block, faces that are hidden where it is below them are taken only if no
/// other face bounds the block there, and the faces beside them go on behind them; null: none are
[[nodiscard]] PairContacts find_contacts(const PlacedSurface& a, const PlacedSurface& b,
                                         const ContactLimits& limits, const OccludedPlaces* hidden = nullptr);

}  // namespace ashlar

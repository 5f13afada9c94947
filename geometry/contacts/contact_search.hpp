// Finds the contacts of two blocks at their current positions, for the mechanics layer (theory.md section 6).
//
// Faces that face each other within the contact angle have face-face contact: the overlap polygons of their cells,
// whose closure includes all vertex-face, edge-face and crossing points. Beyond that angle a vertex of one block has
// contact with a face of the other (vertex-face; both ends of an edge within the angle: edge-face), and two edges
// have contact where they cross (edge-edge). A vertex over an edge or a vertex is assigned to the one face it has
// entered least. The first block is called a, the second b; normals point out of b, towards a.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/contact_type.hpp"
#include "geometry/contacts/cell_overlap.hpp"

namespace ashlar {

/// Limits of contact detection. The comparison with each limit is the user's resolution, and applied nowhere else.
/// Largest angle between faces in face-face contact.
class ContactAngle {
 public:
  /// @param angle rad, 0 to pi/4
  ContactAngle(double angle);
  [[nodiscard]] double cosine() const { return cosine_; }
  [[nodiscard]] double sine() const { return sine_; }

 private:
  double cosine_;
  double sine_;
};

struct ContactLimits {
  double reach = 0.0;        ///< m, largest gap, beyond the chord bounds of curved cells
  double penetration = 0.0;  ///< m, largest depth of an entrance through this face
  ContactAngle angle = 0.0;
  /// m, largest depth of any contact, for cells of any size: beyond it, faces may face each other from opposite sides
  /// of both blocks
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
  /// Type of two convex solids as a whole (convex_search.hpp).
  std::optional<ContactType> type;
  DecisionCounts counts;
  long cells_near = 0;  ///< of both, by their boxes
  [[nodiscard]] bool empty() const { return overlaps.empty() && vertices.empty() && edges.empty(); }
};

/// Mean over the faces around some cells of the area that falls to one corner of each, m^2.
[[nodiscard]] double tributary_area(const SubFaceSurface& surface, const std::vector<int>& cells);

/// Places of a pair's faces that lie on a third block, where a vertex can enter or leave through that block only.
struct OccludedPlaces {
  using Hides = std::function<bool(int face, const Vector3& place)>;
  Hides of_a;
  Hides of_b;
};

/// Finds all contacts of two blocks. The result is symmetric: swapping a and b swaps their roles in it.
/// @param hidden for a vertex inside a block, faces occluded where it is below them are used only if no other face
/// bounds the block there, and the adjacent faces extend behind them; null: no occlusion
[[nodiscard]] PairContacts find_contacts(const PlacedSurface& a, const PlacedSurface& b,
                                         const ContactLimits& limits, const OccludedPlaces* hidden = nullptr);

}  // namespace ashlar

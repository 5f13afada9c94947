// Finds the contacts of two blocks at their current positions, for the mechanics layer (theory.md section 6).
//
// Faces that face each other within the contact angle meet as face-face: the overlap polygons of their cells,
// which hold all vertex-face, edge-face and crossing points in their closure. Beyond that angle a vertex of
// one block meets a face of the other (vertex-face; both ends of an edge that lies within the angle:
// edge-face), and two edges meet where they cross (edge-edge). A vertex over an edge or a vertex is given the
// one face it has entered least. The first block is called a, the second b; normals point out of b, towards
// a.
#pragma once

#include <vector>

#include "geometry/cell_overlap.hpp"
#include "geometry/sub_face_surface.hpp"

namespace ashlar {

/// Axis-parallel box.
struct Box {
  Vector3 low;
  Vector3 high;
  [[nodiscard]] bool meets(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// The current shape of a surface: what the search needs more than once.
class PlacedSurface {
 public:
  /// @param surface must outlive this. @param points (#surface.points), current positions, m
  PlacedSurface(const SubFaceSurface& surface, std::vector<Vector3> points);

  [[nodiscard]] const SubFaceSurface& surface() const { return *surface_; }
  [[nodiscard]] const std::vector<Vector3>& points() const { return points_; }
  [[nodiscard]] const Vector3& point(int index) const { return points_[static_cast<std::size_t>(index)]; }
  /// Outward unit normal of a cell (of its area vector; zero if the cell has collapsed).
  [[nodiscard]] const Vector3& normal(int cell) const { return normals_[static_cast<std::size_t>(cell)]; }
  [[nodiscard]] const Box& cell_box(int cell) const { return cell_boxes_[static_cast<std::size_t>(cell)]; }
  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] std::vector<Vector3> corners(int cell) const;

 private:
  const SubFaceSurface* surface_;
  std::vector<Vector3> points_;
  std::vector<Vector3> normals_;
  std::vector<Box> cell_boxes_;
  Box box_;
};

/// What counts as a contact. The comparison with each limit is the user's resolution, never hidden elsewhere.
struct ContactLimits {
  double reach = 0.0;        ///< m, largest gap
  double penetration = 0.0;  ///< m, deepest entrance that is still taken as one through this face
  double angle = 0.0;        ///< rad, how far two faces may be from parallel to meet as face-face, 0 to pi/4
};

/// Two cells whose faces face each other.
struct CellOverlap {
  int cell_a;
  int cell_b;
  ViewFrame frame;                     ///< w is the mean direction of the two normals, out of b
  std::vector<OverlapCorner> corners;  ///< at least 3
  std::vector<double> gaps;            ///< of the flat cells at each corner along w, m
};

/// A vertex of one block over a cell of the other.
struct VertexContact {
  bool vertex_of_a;  ///< true: vertex of a over a cell of b
  int vertex;        ///< index into SubFaceSurface::vertices of its block
  int cell;          ///< of the other block
  double gap;        ///< m, along the cell's normal
  double area;       ///< tributary area of the vertex, m^2
};

/// Two edges crossing.
struct EdgeContact {
  int edge_a;  ///< index into SubFaceSurface::edges
  int edge_b;
  double along_a;  ///< place of the crossing on each edge, 0 to 1 from its first end
  double along_b;
  Vector3 normal;  ///< unit, across both edges, out of b
  double gap;      ///< m
  double area;     ///< tributary area, m^2
};

/// All contacts of a pair of blocks.
struct PairContacts {
  std::vector<CellOverlap> overlaps;
  std::vector<VertexContact> vertices;
  std::vector<EdgeContact> edges;
  PredicateCounts counts;
  [[nodiscard]] bool empty() const { return overlaps.empty() && vertices.empty() && edges.empty(); }
};

/// Finds every contact of two blocks. The answer is symmetric: swapping a and b swaps their roles in it.
[[nodiscard]] PairContacts find_contacts(const PlacedSurface& a, const PlacedSurface& b,
                                         const ContactLimits& limits);

/// Pairs (i < j) of closed boxes that meet, sorted. O(N log N + pairs whose extents meet along the longest
/// axis).
[[nodiscard]] std::vector<std::array<int, 2>> meeting_boxes(const std::vector<Box>& boxes);

}  // namespace ashlar

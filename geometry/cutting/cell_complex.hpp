// A solid as a complex of cells: any two of them meet in common faces, edges and points, and a face between two cells
// is one object, not two equal ones. So a plane that divides a face divides it for both cells, without gaps or
// overlaps. Only sources of this layer include this file.
//
// Every point is the common point of three given planes, never of computed ones, so its integers do not grow with the
// number of cuts. Division of a cell by a plane needs only the side of each of the cell's points, and for nonconvex
// faces the order of points along a line. If only one of two neighbours is divided, the face between them is divided
// all the same: then faces of one cell may be coplanar, and points of a face's loop may lie in straight sides.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/convex/convex_shape.hpp"
#include "geometry/cutting/exact_plane.hpp"

namespace ashlar {

struct ComplexPoint {
  ExactPoint place;
  std::vector<int> planes;  ///< some of the planes that contain it, in the order of detection
};

struct ComplexEdge {
  std::array<int, 2> points;
  std::array<int, 2> planes;  ///< two planes whose common line carries it
  std::vector<int> faces;     ///< around it, each once
};

/// The outline of a connected part of a plane: its outer loop counter-clockwise as seen from above the plane, then
/// those of holes. It may touch itself in points, and have an edge in both directions.
struct FaceOutline {
  std::vector<int> points;  ///< loop by loop
  std::vector<int> edges;   ///< edge k joins point k and the next one of its loop
  std::vector<int> holes;   ///< where the loops after the first start, increasing
};

struct ComplexFace : FaceOutline {
  int plane = -1;
  std::array<int, 2> cells = {-1, -1};  ///< the one below the plane and the one above; -1: none
  int mark = -1;                        ///< of the cut that made it; -1: of the solid's surface
  bool convex = true;                   ///< one loop without a reflex corner
};

/// A side of an outline, which has the face on its left as seen from above the plane.
struct OutlineSide {
  int from, to;  ///< points
  int edge;
};

[[nodiscard]] std::vector<OutlineSide> sides_of(const FaceOutline& outline);
/// The points of each loop.
[[nodiscard]] std::vector<std::span<const int>> loops_of(const FaceOutline& outline);

/// A connected solid whose surface is one shell, as made by division with planes.
struct ComplexCell {
  std::vector<int> faces;
  bool convex = true;  ///< all faces, too
};

/// A face of a cell that is assembled with others.
struct CellFace {
  int plane;
  bool below;                    ///< the cell is below the plane
  int mark;                      ///< as in ComplexFace
  std::vector<ExactPoint> loop;  ///< corners, counter-clockwise as seen from above the plane
};

/// Common parts of assembled cells.
struct CellSeams {
  std::map<std::array<Integer, 4>, int> points;  ///< by coordinates
  std::map<std::array<int, 2>, int> edges;       ///< by points, increasing
  std::map<std::vector<int>, int> faces;         ///< by points, increasing
};

/// Points, edges, faces, cells and planes are numbered from 0 and keep their numbers.
class CellComplex {
 public:
  CellComplex() = default;

  int add_plane(const ExactPlane& plane);
  /// A convex solid as a cell of its own. @pre not flat
  int add_cell(const ConvexShape& shape);
  /// A solid as a cell of its own. Triangles in one plane that are connected over edges make a face.
  /// @param surface closed, outward, without self-intersections, of a connected solid; it may touch itself
  int add_cell(const TriangleMesh& surface);
  /// Adds a convex cell that fits others: existing common points, edges and faces are shared.
  int add_cell(const std::vector<CellFace>& faces, CellSeams& seams);

  [[nodiscard]] const ExactPlane& plane(int index) const { return planes_[index]; }
  [[nodiscard]] const ComplexPoint& point(int index) const { return points_[index]; }
  [[nodiscard]] const ComplexEdge& edge(int index) const { return edges_[index]; }
  [[nodiscard]] const ComplexFace& face(int index) const { return faces_[index]; }
  /// Faces of a cell.
  [[nodiscard]] const std::vector<int>& faces(int cell) const { return cells_[cell].faces; }
  [[nodiscard]] bool convex(int cell) const { return cells_[cell].convex; }
  [[nodiscard]] int cell_count() const { return static_cast<int>(cells_.size()); }
  [[nodiscard]] std::size_t point_count() const { return points_.size(); }
  /// Each once, increasing.
  [[nodiscard]] std::vector<int> points_of(int cell) const;

  /// 1 above the plane, 0 on it, -1 below.
  [[nodiscard]] int side(int plane, int point) const;
  /// 1 or -1 if the cell is above or below the plane, except points on it; 0 if the plane divides it.
  [[nodiscard]] int side_of_cell(int plane, int cell) const;
  /// Divides a convex cell: it keeps the part below. @pre the plane divides it. @param mark of the face between the
  /// two
  /// @return the cell above
  int part(int cell, int plane, int mark);
  void set_mark(int face, int mark) { faces_[face].mark = mark; }
  /// Removes a cell; its number is not used again, and has no faces.
  void remove(int cell);

  // Parts of the division of any cell (cell_parting.hpp).
  int add_edge(int from, int to, std::array<int, 2> planes);
  /// A face without adjacent cells.
  int add_face(int plane, FaceOutline outline, int mark);
  /// A cell without faces.
  int add_cell(bool convex);
  /// Replaces the surface of a cell. @param faces and whether the cell is below them
  void set_faces(int cell, const std::vector<std::pair<int, bool>>& faces);
  /// @pre the cell is convex, and so are its faces
  void set_convex(int cell) { cells_[cell].convex = true; }
  /// Divides an edge at its intersection with the plane. @pre its ends are on different sides
  void divide_edge(int edge, int plane);
  /// Divides a convex face: it keeps the part below the plane. @pre the plane divides it
  void divide_convex_face(int face, int plane);
  /// Divides a face into others. @param outlines of its parts, at least one; the face keeps the first
  void divide_face(int face, std::vector<FaceOutline> outlines);

 private:
  int add_point(ComplexPoint point);
  void set_outline(int face, FaceOutline outline);
  void forget_face(int face);
  int seam_point(const ExactPoint& place, int plane, CellSeams& seams);
  int seam_edge(int from, int to, int plane, CellSeams& seams);
  void add_section(int below, int above, int plane, int mark);
  void exchange_cell(int face, int old_cell, int new_cell);

  std::vector<ExactPlane> planes_;
  mutable std::vector<ComplexPoint> points_;  ///< their lists of planes grow by detection
  std::vector<ComplexEdge> edges_;
  std::vector<ComplexFace> faces_;
  std::vector<ComplexCell> cells_;
};

}  // namespace ashlar

// A solid that planes and surfaces cut into pieces which fit together exactly; notes/cutting.md says why.
//
// Every corner is the common point of three given planes, decided exactly and rounded once, so that
// neighbours have the same corners to the last bit. Pieces are made of cells: one each, until some are glued or a
// surface has cut them.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/cutting/cut_error.hpp"
#include "geometry/cutting/cut_plane.hpp"
#include "geometry/cutting/key_block.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Most cells that cuts along the surface of a solid, or the convex parts of one, may come to.
inline constexpr int most_surface_cells = 200000;

/// A part of a piece's surface: all that is in one plane, on one side of it and next to one neighbour.
struct PieceFace {
  int plane;               ///< the same number: the same plane
  bool below;              ///< the piece is below it
  int neighbour;           ///< piece on the other side, -1: outside of the solid
  int mark;                ///< of the cut that made it, -1: of the solid's own surface
  std::vector<int> parts;  ///< flat parts, by numbers that the neighbour's face has too
};

/// A face that holds a piece in its place.
struct HeldFace {
  int plane;
  bool below;
};

/// Pieces are numbered from 0, the solid as a whole first. One that is cut or glued away is no more; its
/// number is not used again, but for the first part of what was cut.
class CutSolid {
 public:
  /// Whether a piece that is met is to be cut.
  using Choice = std::function<bool(int piece)>;

  /// A convex solid is the convex hull of its corners; any other has the faces that its triangles are, exactly.
  explicit CutSolid(const Polyhedron& solid);
  ~CutSolid();
  CutSolid(CutSolid&&) noexcept;
  CutSolid& operator=(CutSolid&&) noexcept;

  /// In order: what was cut off a piece follows it.
  [[nodiscard]] std::vector<int> pieces() const;
  /// 0, or what cut_along gave.
  [[nodiscard]] int label(int piece) const;
  /// Least and greatest normal . (x - point) of a piece, rounded.
  [[nodiscard]] std::pair<double, double> extent(int piece, const CutPlane& plane) const;
  /// m, rounded: from the plane's point, which lies in the plane, to what it cuts out of a piece; infinite if
  /// it does not part the piece.
  [[nodiscard]] double distance_in_plane(int piece, const CutPlane& plane) const;

  /// Parts pieces. A plane that only touches a piece, or misses it, does nothing, and does not ask. What is
  /// not connected over faces is several pieces. @param mark >= 0, of the faces that come about.
  void cut(const CutPlane& plane, int mark, const Choice& chosen);
  /// Parts pieces along the surface of a solid. @param label of what is inside
  /// @throws CutError if that takes too many cells
  void cut_along(const Polyhedron& surface, int mark, int label, const Choice& chosen);
  /// @throws CutError unless the solid is convex and was not cut before
  void require_cells() const;
  /// Parts the whole into the Voronoi cells of points: all that is nearer to one of them than to any other.
  /// Cells follow the order of the points; those that do not meet the solid are left out. @param mark as of
  /// cut()
  /// @throws CutError as require_cells(), or if two points are one
  void cut_into_cells(const std::vector<Vector3>& points, int mark);
  /// Makes two pieces one. @param into keeps its number
  void glue(int piece, int into);

  /// m^3, rounded once.
  [[nodiscard]] double volume(int piece) const;
  /// By plane, side, neighbour and mark.
  [[nodiscard]] std::vector<PieceFace> faces(int piece) const;
  /// m^2, rounded once.
  [[nodiscard]] double area(const PieceFace& face) const;
  /// Outward, unit, rounded once.
  [[nodiscard]] Vector3 normal(const PieceFace& face) const;
  /// Corners rounded once. Points of the solid within a resolution of each other are one, the first in
  /// number, for all pieces alike: so a face that is a sliver between two others goes, and these meet. What
  /// is left without area is left out. @param resolution m, >= 0
  [[nodiscard]] TriangleMesh mesh(int piece, double resolution = 0.0) const;
  /// @param held faces of the piece; KeyBlock::faces are indices into it. @param force any length but zero
  [[nodiscard]] KeyBlock key_block(int piece, const std::vector<HeldFace>& held, const Vector3& force) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ashlar

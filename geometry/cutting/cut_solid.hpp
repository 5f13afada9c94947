// A solid cut by planes and surfaces into pieces that fit together exactly; see notes/cutting.md.
//
// Every corner is the common point of three given planes, decided exactly and rounded once, so that neighbours have
// the same corners to the last bit. Pieces are made of cells: one each, until some are glued or a surface has cut
// them.
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

/// Largest number of cells made by cuts along the surface of a solid, or by division into convex parts.
inline constexpr int most_surface_cells = 200000;

/// A part of a piece's surface: all faces in one plane, on one side of it and next to one neighbour.
struct PieceFace {
  int plane;               ///< the same number: the same plane
  bool below;              ///< the piece is below it
  int neighbour;           ///< piece on the other side, -1: outside of the solid
  int mark;                ///< of the cut that made it, -1: of the solid's own surface
  std::vector<int> parts;  ///< flat parts, by numbers that the neighbour's face has too
};

/// A face that restrains a piece.
struct HeldFace {
  int plane;
  bool below;
};

/// Pieces are numbered from 0, the whole solid first. The number of a piece that is cut or glued is not used again,
/// except for the first part of a cut piece.
class CutSolid {
 public:
  /// True if a piece that is crossed is to be cut.
  using Choice = std::function<bool(int piece)>;

  /// A convex solid is the convex hull of its corners; any other one has the exact faces of its triangles.
  explicit CutSolid(const Polyhedron& solid);
  ~CutSolid();
  CutSolid(CutSolid&&) noexcept;
  CutSolid& operator=(CutSolid&&) noexcept;

  /// In order: a part cut off a piece follows it.
  [[nodiscard]] std::vector<int> pieces() const;
  /// 0, or the label given to cut_along.
  [[nodiscard]] int label(int piece) const;
  /// Least and greatest normal . (x - point) of a piece, rounded.
  [[nodiscard]] std::pair<double, double> extent(int piece, const CutPlane& plane) const;
  /// m, rounded: distance in the plane from the plane's point to the section of a piece; infinite if the plane does
  /// not divide the piece.
  [[nodiscard]] double distance_in_plane(int piece, const CutPlane& plane) const;

  /// Divides pieces. A plane that only touches a piece, or misses it, has no effect, and `chosen` is not called.
  /// Parts not connected by faces are separate pieces. @param mark >= 0, of the new faces.
  void cut(const CutPlane& plane, int mark, const Choice& chosen);
  /// Divides pieces along the surface of a solid. @param label of the parts inside
  /// @throws CutError if too many cells are needed
  void cut_along(const Polyhedron& surface, int mark, int label, const Choice& chosen);
  /// @throws CutError unless the solid is convex and was not cut before
  void require_cells() const;
  /// Divides the whole into the Voronoi cells of points: all places closer to one of them than to any other. Cells
  /// are in the order of the points; those outside of the solid are omitted. @param mark as for cut()
  /// @throws CutError as require_cells(), or if two points coincide
  void cut_into_cells(const std::vector<Vector3>& points, int mark);
  /// Merges two pieces. @param into keeps its number
  void glue(int piece, int into);

  /// m^3, rounded once.
  [[nodiscard]] double volume(int piece) const;
  /// By plane, side, neighbour and mark.
  [[nodiscard]] std::vector<PieceFace> faces(int piece) const;
  /// m^2, rounded once.
  [[nodiscard]] double area(const PieceFace& face) const;
  /// Outward, unit, rounded once.
  [[nodiscard]] Vector3 normal(const PieceFace& face) const;
  /// Corners rounded once. Points of the solid within a resolution of each other are merged to the first in number,
  /// for all pieces alike: a face that is a sliver between two others vanishes, and these become adjacent. Parts
  /// without area are omitted.
  /// @param resolution m, >= 0
  [[nodiscard]] TriangleMesh mesh(int piece, double resolution = 0.0) const;
  /// @param held faces that restrain the piece; KeyBlock::faces are indices into it. @param force of any length but
  /// zero. @param barred directions, of any length but zero, along which the piece cannot move, as outward normals of
  /// further faces that restrain it: their indices follow those of `held`
  [[nodiscard]] KeyBlock key_block(int piece, const std::vector<HeldFace>& held, const Vector3& force,
                                   const std::vector<Vector3>& barred = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ashlar

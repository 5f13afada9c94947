#include "geometry/contacts/overlap_vertices.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Location of a corner of an overlap on a face, ignoring its inner sides and points.
struct FacePlace {
  int dimension;  ///< 0: at a vertex of the outline, 1: inside an edge, 2: inside
  int index;      ///< vertex, edge of the polyhedron; inside: -1
  int side;       ///< side of the cell on that edge
};

FacePlace place_on_face(const SubFaceSurface& surface, const SurfaceCell& cell,
                        const PlaneLocation& location) {
  if (location.dimension == 2) return {2, -1, -1};
  if (location.dimension == 1) {
    const int edge = cell.rim[at(location.index)];
    return edge < 0 ? FacePlace{2, -1, -1} : FacePlace{1, edge, location.index};
  }
  const int vertex = surface.vertex_of_point[at(cell.corners[at(location.index)])];
  if (vertex >= 0) return {0, vertex, -1};
  // A point of the mesh that is no corner: inside the face or inside one of its edges.
  const int count = static_cast<int>(cell.corners.size());
  for (const int side : {location.index, (location.index + count - 1) % count}) {
    if (cell.rim[at(side)] >= 0) return {1, cell.rim[at(side)], side};
  }
  return {2, -1, -1};
}

/// True if two sides are parallel in the projection along w.
bool parallel_sides(const PlacedSurface& a, const CellOverlap& overlap, int side_a, const PlacedSurface& b,
                    int side_b) {
  const auto ends = [](const PlacedSurface& s, int cell, int side) {
    const auto& corners = s.surface().cells[at(cell)].corners;
    return std::array{&s.point(corners[(at(side) + 1) % corners.size()]), &s.point(corners[at(side)])};
  };
  const auto of_a = ends(a, overlap.cell_a, side_a);
  const auto of_b = ends(b, overlap.cell_b, side_b);
  PredicateLadder ladder{false, {}};
  return sign_triple(ContactDirection::along({&overlap.frame.w}), {of_a[0], of_a[1]}, {of_b[0], of_b[1]},
                     ladder) == 0;
}

/// Features that make a polygon vertex: the same in all cell overlaps with this corner.
using PointName = std::array<int, 4>;

/// The ends of the side, or twice the point, of a location.
std::array<int, 2> points_of(const SurfaceCell& cell, const PlaneLocation& location) {
  if (location.dimension == 2) return {-1, -1};
  const int first = cell.corners[at(location.index)];
  if (location.dimension == 0) return {first, first};
  const int second = cell.corners[(at(location.index) + 1) % cell.corners.size()];
  return {std::min(first, second), std::max(first, second)};
}

/// Name of a corner of the division: a point of either block is one corner, over any cell of the other.
PointName division_name(const SurfaceCell& cell_a, const SurfaceCell& cell_b, const OverlapCorner& corner) {
  const auto in_a = points_of(cell_a, corner.in_a);
  const auto in_b = points_of(cell_b, corner.in_b);
  if (corner.in_a.dimension == 0) return {in_a[0], in_a[1], -1, -1};
  if (corner.in_b.dimension == 0) return {-1, -1, in_b[0], in_b[1]};
  return {in_a[0], in_a[1], in_b[0], in_b[1]};
}

/// Name of a vertex of the polygon of two flat faces; empty for a corner made by inner sides.
std::optional<PointName> polygon_name(const PlacedSurface& a, const PlacedSurface& b,
                                      const CellOverlap& overlap, const OverlapCorner& corner) {
  const FacePlace on_a = place_on_face(a.surface(), a.surface().cells[at(overlap.cell_a)], corner.in_a);
  const FacePlace on_b = place_on_face(b.surface(), b.surface().cells[at(overlap.cell_b)], corner.in_b);
  if (on_a.dimension == 0) return PointName{0, on_a.index, -1, -1};
  if (on_b.dimension == 0) return PointName{-1, -1, 0, on_b.index};
  if (on_a.dimension == 2 || on_b.dimension == 2) return std::nullopt;
  const bool crossing = corner.in_a.dimension == 1 && corner.in_b.dimension == 1;
  if (!crossing && parallel_sides(a, overlap, on_a.side, b, on_b.side)) return std::nullopt;
  return PointName{1, on_a.index, 1, on_b.index};
}

}  // namespace

std::vector<FaceOverlap> join_by_faces(const PlacedSurface& a, const PlacedSurface& b,
                                       const std::vector<CellOverlap>& overlaps) {
  struct Join {
    FaceOverlap overlap;
    std::set<PointName> names;
  };
  std::map<std::array<int, 2>, Join> joins;
  const bool divided = a.surface().divided || b.surface().divided;
  for (std::size_t n = 0; n < overlaps.size(); ++n) {
    const CellOverlap& overlap = overlaps[n];
    const SurfaceCell& cell_a = a.surface().cells[at(overlap.cell_a)];
    const SurfaceCell& cell_b = b.surface().cells[at(overlap.cell_b)];
    Join& join = joins[{cell_a.face, cell_b.face}];
    join.overlap.face_a = cell_a.face;
    join.overlap.face_b = cell_b.face;
    join.overlap.cells.push_back(static_cast<int>(n));
    for (std::size_t k = 0; k < overlap.corners.size(); ++k) {
      const std::optional<PointName> name = divided ? division_name(cell_a, cell_b, overlap.corners[k])
                                                    : polygon_name(a, b, overlap, overlap.corners[k]);
      if (name && join.names.insert(*name).second)
        join.overlap.points.push_back({static_cast<int>(n), static_cast<int>(k)});
    }
  }
  std::vector<FaceOverlap> result;
  result.reserve(joins.size());
  for (auto& [faces, join] : joins) result.push_back(std::move(join.overlap));
  return result;
}

}  // namespace ashlar

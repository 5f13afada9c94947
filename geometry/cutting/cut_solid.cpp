#include "geometry/cutting/cut_solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "geometry/boxes/box.hpp"
#include "geometry/cutting/cell_parting.hpp"
#include "geometry/cutting/convex_parts.hpp"
#include "geometry/cutting/joint_pyramid.hpp"
#include "geometry/cutting/piece_measures.hpp"
#include "geometry/cutting/piece_mesh.hpp"
#include "geometry/cutting/surface_partition.hpp"
#include "geometry/cutting/voronoi_complex.hpp"
#include "geometry/exact/rounding_mode.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {
// Not inlined where the rounding mode changes: State does the work, CutSolid guards it.
struct CutSolid::State {
  struct Piece {
    std::vector<int> cells;  ///< empty: the piece does not exist any more
    Box box;
    int label = 0;
    int next = -1;  ///< in order
  };

  CellComplex complex;
  std::vector<Piece> pieces;
  std::vector<int> piece_of;  ///< by cell
  mutable std::optional<PieceMeasures> measures;
  mutable std::vector<int> merged_points;  ///< for one resolution; empty: unknown
  mutable double merged_to = 0.0;

  [[gnu::noinline]] void start(const Polyhedron& solid) {
    Piece whole;
    whole.cells = {solid.convex() ? complex.add_cell(ConvexShape::from_polyhedron(solid))
                                  : complex.add_cell(solid.mesh())};
    pieces.push_back(std::move(whole));
    settle(0);
  }

  [[nodiscard]] std::vector<int> order() const {
    std::vector<int> result;
    for (int piece = 0; piece >= 0; piece = pieces[piece].next)
      if (!pieces[piece].cells.empty()) result.push_back(piece);
    return result;
  }

  /// Updates the data derived from a piece's cells.
  void settle(int index) {
    Piece& piece = pieces[index];
    piece.box = Box();
    piece_of.resize(static_cast<std::size_t>(complex.cell_count()), -1);
    merged_points.clear();
    for (const int cell : piece.cells) {
      piece_of[cell] = index;
      for (const int point : complex.points_of(cell)) piece.box.include(complex.point(point).place.rounded);
    }
  }

  /// -1 or 1 if a piece is completely below or above, else 0; `parted` if a cell is divided, not only the piece.
  [[nodiscard]] int side_of(int index, int plane) const {
    if (const int side = complex.plane(plane).side_of_box(pieces[index].box.low, pieces[index].box.high))
      return side;
    int found = 0;
    for (const int cell : pieces[index].cells) {
      const int side = complex.side_of_cell(plane, cell);
      if (side == 0 || side * found < 0) return 0;
      found = side;
    }
    return found;
  }

  [[gnu::noinline]] void cut(const CutPlane& by, int mark, const Choice& chosen) {
    const ExactPlane exact(by);
    int plane = -1;
    for (const int index : order()) {
      if (exact.side_of_box(pieces[index].box.low, pieces[index].box.high) != 0) continue;
      if (plane < 0) plane = complex.add_plane(exact);
      if (side_of(index, plane) != 0 || !chosen(index)) continue;
      std::vector<std::pair<int, int>> sorted;  // class and cell
      const std::vector<int> cells = pieces[index].cells;
      for (const int cell : cells) {
        if (const int side = complex.side_of_cell(plane, cell)) {
          sorted.emplace_back(side > 0 ? 1 : 0, cell);
          continue;
        }
        const CellParts parts = part_cell(complex, cell, plane, mark);
        for (const int part : parts.below) sorted.emplace_back(0, part);
        for (const int part : parts.above) sorted.emplace_back(1, part);
      }
      divide(index, sorted, mark);
    }
  }

  [[gnu::noinline]] void cut_along(const Polyhedron& surface, int mark, int label, const Choice& chosen) {
    const Box box = box_of(surface.mesh().points);
    for (const int index : order()) {
      if (!pieces[index].box.meets(box) || !chosen(index)) continue;
      std::vector<int> cells;
      for (const int cell : pieces[index].cells)
        for (const int part : convex_parts(complex, cell, mark, most_surface_cells)) cells.push_back(part);
      std::vector<std::pair<int, int>> sorted;
      for (const CellSide& leaf :
           partition_by_surface(complex, cells, surface.mesh(), mark, most_surface_cells))
        sorted.emplace_back(leaf.inside ? 1 : 0, leaf.cell);
      divide(index, sorted, mark);
      for (const auto& [inside, cell] : sorted)
        if (inside != 0) pieces[piece_of[cell]].label = label;
    }
  }

  void require_cells() const {
    if (pieces.size() != 1 || pieces[0].cells.size() != 1 || !complex.convex(pieces[0].cells[0]))
      throw CutError("cells around points need a block that is convex and was not cut before");
  }

  [[gnu::noinline]] void cut_into_cells(const std::vector<Vector3>& points, int mark) {
    require_cells();
    complex = voronoi_complex(complex, points, mark);
    measures.reset();
    pieces.clear();
    piece_of.clear();
    for (int cell = 0; cell < complex.cell_count(); ++cell) {
      pieces.push_back({{cell}, {}, 0, cell + 1 < complex.cell_count() ? cell + 1 : -1});
      settle(cell);
    }
  }

  /// Makes pieces of a piece's cells: those of one class connected by faces.
  void divide(int index, std::vector<std::pair<int, int>> sorted, int mark) {
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::map<int, int> place;
    for (std::size_t k = 0; k < sorted.size(); ++k) place[sorted[k].second] = static_cast<int>(k);
    UnionFind connected(sorted.size());
    for (const auto& [kind, cell] : sorted) {
      for (const int face : complex.faces(cell)) {
        const auto& [below, above] = complex.face(face).cells;
        const auto a = place.find(below), b = place.find(above);
        if (a == place.end() || b == place.end()) continue;
        if (sorted[a->second].first == sorted[b->second].first) connected.unite(a->second, b->second);
      }
    }
    std::map<int, int> piece_of_root;
    int last = index;
    const int after = pieces[index].next, label = pieces[index].label;
    pieces[index].cells.clear();
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      const int root = connected.find(static_cast<int>(k));
      const auto [found, is_new] = piece_of_root.emplace(root, index);
      if (is_new && piece_of_root.size() > 1) {
        found->second = static_cast<int>(pieces.size());
        pieces.push_back({{}, {}, label, after});
        pieces[last].next = found->second;
        last = found->second;
      }
      pieces[found->second].cells.push_back(sorted[k].second);
    }
    for (const auto& [root, piece] : piece_of_root) settle(piece);
    for (const auto& [kind, cell] : sorted)
      for (const int face : complex.faces(cell)) mark_between(face, place, mark);
  }

  /// A face between two parts of a former piece belongs to the cut, even if it was inside before.
  void mark_between(int face, const std::map<int, int>& cells, int mark) {
    const auto& [below, above] = complex.face(face).cells;
    if (cells.contains(below) && cells.contains(above) && piece_of[below] != piece_of[above])
      complex.set_mark(face, mark);
  }

  [[gnu::noinline]] void glue(int piece, int into) {
    std::vector<int>& cells = pieces[into].cells;
    cells.insert(cells.end(), pieces[piece].cells.begin(), pieces[piece].cells.end());
    pieces[piece].cells.clear();
    settle(into);
  }

  /// Faces on a piece's surface, and whether the piece is below their planes.
  [[nodiscard]] std::vector<std::pair<int, bool>> surface(int index) const {
    std::vector<std::pair<int, bool>> result;
    for (const int cell : pieces[index].cells) {
      for (const int face : complex.faces(cell)) {
        const auto& cells = complex.face(face).cells;
        const bool below = cells[0] == cell;
        const int other = cells[below ? 1 : 0];
        if (other < 0 || piece_of[other] != index) result.emplace_back(face, below);
      }
    }
    return result;
  }

  [[nodiscard]] const std::vector<int>& merged(double resolution) const {
    if (merged_points.empty() || merged_to != resolution) {
      merged_points = merge_points(complex, resolution);
      merged_to = resolution;
    }
    return merged_points;
  }

  [[nodiscard]] PieceMeasures& measure() const {
    if (!measures) measures.emplace(complex);
    return *measures;
  }

  [[nodiscard]] std::vector<PieceFace> faces(int index) const {
    std::map<std::tuple<int, bool, int, int>, std::vector<int>> groups;
    for (const auto& [face, below] : surface(index)) {
      const ComplexFace& of = complex.face(face);
      const int other = of.cells[below ? 1 : 0];
      groups[{of.plane, below, other < 0 ? -1 : piece_of[other], of.mark}].push_back(face);
    }
    std::vector<PieceFace> result;
    for (auto& [key, members] : groups) {
      const auto& [plane, below, neighbour, mark] = key;
      result.push_back({plane, below, neighbour, mark, std::move(members)});
    }
    return result;
  }

  [[nodiscard]] IntegerVector outward(int plane, bool below) const {
    const auto& [a, b, c, d] = complex.plane(plane).coefficients();
    if (below) return {a, b, c};
    return {Integer(-a), Integer(-b), Integer(-c)};
  }

  [[nodiscard]] KeyBlock key_block(int index, const std::vector<HeldFace>& held, const Vector3& force,
                                   const std::vector<Vector3>& barred) const {
    std::vector<IntegerVector> holding, free;
    for (const HeldFace& face : held) holding.push_back(outward(face.plane, face.below));
    for (const Vector3& normal : barred) holding.push_back(in_integers(normal));
    for (const auto& [face, below] : surface(index)) {
      const int plane = complex.face(face).plane;
      const bool is_held = std::any_of(held.begin(), held.end(), [&, side = below](const HeldFace& of) {
        return of.plane == plane && of.below == side;
      });
      if (!is_held) free.push_back(outward(plane, below));
    }
    return find_key_block(holding, free, force);
  }

  [[nodiscard]] double distance_in_plane(int index, const CutPlane& by) const {
    const ExactPlane plane(by);
    const ExactPoint centre = ExactPoint::of(by.point);
    double nearest = std::numeric_limits<double>::infinity();
    for (const int cell : pieces[index].cells)
      nearest = std::min(nearest, distance_from_section(complex, cell, plane, centre));
    return nearest;
  }
};

CutSolid::CutSolid(const Polyhedron& solid) : state_(std::make_unique<State>()) {
  const NearestRounding nearest;
  state_->start(solid);
}

CutSolid::~CutSolid() = default;
CutSolid::CutSolid(CutSolid&&) noexcept = default;
CutSolid& CutSolid::operator=(CutSolid&&) noexcept = default;

std::vector<int> CutSolid::pieces() const {
  return state_->order();
}

int CutSolid::label(int piece) const {
  return state_->pieces[piece].label;
}

std::pair<double, double> CutSolid::extent(int piece, const CutPlane& plane) const {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const int cell : state_->pieces[piece].cells) {
    for (const int point : state_->complex.points_of(cell)) {
      const double height = plane.normal.dot(state_->complex.point(point).place.rounded - plane.point);
      least = std::min(least, height);
      most = std::max(most, height);
    }
  }
  return {least, most};
}

double CutSolid::distance_in_plane(int piece, const CutPlane& plane) const {
  const NearestRounding nearest;
  return state_->distance_in_plane(piece, plane);
}

void CutSolid::cut(const CutPlane& plane, int mark, const Choice& chosen) {
  const NearestRounding nearest;
  state_->cut(plane, mark, chosen);
}

void CutSolid::cut_along(const Polyhedron& surface, int mark, int label, const Choice& chosen) {
  const NearestRounding nearest;
  state_->cut_along(surface, mark, label, chosen);
}

void CutSolid::require_cells() const {
  state_->require_cells();
}

void CutSolid::cut_into_cells(const std::vector<Vector3>& points, int mark) {
  const NearestRounding nearest;
  state_->cut_into_cells(points, mark);
}

void CutSolid::glue(int piece, int into) {
  state_->glue(piece, into);
}

double CutSolid::volume(int piece) const {
  return state_->measure().volume(state_->surface(piece));
}

std::vector<PieceFace> CutSolid::faces(int piece) const {
  return state_->faces(piece);
}

double CutSolid::area(const PieceFace& face) const {
  return state_->measure().area(face.parts);
}

Vector3 CutSolid::normal(const PieceFace& face) const {
  const Vector3 normal = state_->complex.plane(face.plane).unit_normal();
  return face.below ? normal : Vector3(Vector3::Zero() - normal);
}

TriangleMesh CutSolid::mesh(int piece, double resolution) const {
  return mesh_of_faces(state_->complex, state_->surface(piece), state_->merged(resolution));
}

KeyBlock CutSolid::key_block(int piece, const std::vector<HeldFace>& held, const Vector3& force,
                             const std::vector<Vector3>& barred) const {
  return state_->key_block(piece, held, force, barred);
}

}  // namespace ashlar

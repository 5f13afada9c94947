#include "geometry/cutting/cell_parting.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "geometry/cutting/edge_fan.hpp"
#include "geometry/cutting/face_parting.hpp"
#include "geometry/cutting/plane_regions.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {
namespace {

/// Faces, with true if the cell is below each.
using CellSurface = std::vector<std::pair<int, bool>>;

class CellParting {
 public:
  CellParting(CellComplex& complex, int cell, int plane, int mark)
      : complex_(complex), cell_(cell), plane_(plane), mark_(mark) {}

  [[nodiscard]] CellParts part() {
    divide_faces();
    for (const auto& [face, below] : surface_of(complex_, cell_))
      surface_[side_of(face, below) > 0 ? 1 : 0].emplace_back(face, below);
    for (FaceOutline& outline : plane_regions(complex_, complex_.plane(plane_), section_sides())) {
      const int face = complex_.add_face(plane_, std::move(outline), mark_);
      surface_[0].emplace_back(face, true);
      surface_[1].emplace_back(face, false);
    }
    CellParts parts;
    parts.below = make_cells(surface_[0], true);
    parts.above = make_cells(surface_[1], false);
    return parts;
  }

 private:
  void divide_faces() {
    const std::vector<int> faces = complex_.faces(cell_);
    for (const int face : faces) {
      bool above = false, below = false;
      for (const int point : complex_.face(face).points) {
        const int side = complex_.side(plane_, point);
        above = above || side > 0;
        below = below || side < 0;
      }
      if (above && below) part_face(complex_, face, plane_);
    }
  }

  /// Side of the body bounded by the face, also for a face in the plane.
  [[nodiscard]] int side_of(int face, bool below) const {
    for (const int point : complex_.face(face).points)
      if (const int side = complex_.side(plane_, point)) return side;
    const auto& [a, b, c, d] = complex_.plane(plane_).coefficients();
    const auto& [e, f, g, h] = complex_.plane(complex_.face(face).plane).coefficients();
    return sgn(Integer(a * e + b * f + c * g)) * (below ? -1 : 1);
  }

  /// Around edges in the plane: the cell continues in the plane to the left, the right or both.
  [[nodiscard]] std::vector<OutlineSide> section_sides() const {
    std::vector<OutlineSide> sides;
    for_each_edge(fan_sides(complex_, surface_of(complex_, cell_)), [&](std::vector<FanSide> around) {
      const int edge = around.front().edge;
      const auto [from, to] = complex_.edge(edge).points;
      if (complex_.side(plane_, from) != 0 || complex_.side(plane_, to) != 0) return;
      const EdgeFan fan(complex_, edge, std::move(around));
      if (fan.holds(plane_, 1)) sides.push_back({from, to, edge});
      if (fan.holds(plane_, -1)) sides.push_back({to, from, edge});
    });
    return sides;
  }

  /// Faces belong together if the cell is between them.
  [[nodiscard]] std::vector<CellSurface> connected(const CellSurface& surface) const {
    UnionFind united(surface.size());
    for_each_edge(fan_sides(complex_, surface), [&](const std::vector<FanSide>& around) {
      if (around.size() == 2) {
        united.unite(around[0].face, around[1].face);
        return;
      }
      const EdgeFan fan(complex_, around.front().edge, around);
      const std::vector<FanSide>& sides = fan.sides();
      for (std::size_t k = 0; k < sides.size(); ++k)
        if (sides[k].ahead) united.unite(sides[k].face, sides[(k + 1) % sides.size()].face);
    });
    std::map<int, CellSurface> of_root;
    for (std::size_t k = 0; k < surface.size(); ++k)
      of_root[united.find(static_cast<int>(k))].push_back(surface[k]);
    std::vector<CellSurface> result;
    result.reserve(of_root.size());
    for (auto& [root, faces] : of_root) result.push_back(std::move(faces));
    return result;
  }

  [[nodiscard]] std::vector<int> make_cells(const CellSurface& surface, bool keeps) {
    std::vector<int> cells;
    for (const CellSurface& faces : connected(surface)) {
      cells.push_back(keeps && cells.empty() ? cell_ : complex_.add_cell(false));
      complex_.set_faces(cells.back(), faces);
    }
    return cells;
  }

  CellComplex& complex_;
  int cell_, plane_, mark_;
  std::array<CellSurface, 2> surface_;  ///< below and above the plane
};

}  // namespace

CellParts part_cell(CellComplex& complex, int cell, int plane, int mark) {
  if (complex.convex(cell)) return {{cell}, {complex.part(cell, plane, mark)}};
  return CellParting(complex, cell, plane, mark).part();
}

}  // namespace ashlar

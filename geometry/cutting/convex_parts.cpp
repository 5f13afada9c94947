#include "geometry/cutting/convex_parts.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "geometry/cutting/cell_parting.hpp"
#include "geometry/cutting/cut_error.hpp"
#include "geometry/cutting/edge_fan.hpp"

namespace ashlar {
namespace {

/// A plane through most of the reflex edges. Empty: all adjacent faces make angles of at most 180 degrees.
std::optional<int> plane_through_reflex_edges(const CellComplex& complex, const std::vector<FanSide>& sides) {
  std::map<int, int> counts;
  for_each_edge(sides, [&](const std::vector<FanSide>& around) {
    const EdgeFan fan(complex, around.front().edge, around);
    if (!fan.parting_plane()) return;
    if (around.size() > 2)
      ++counts[*fan.parting_plane()];
    else
      for (const FanSide& side : around) ++counts[side.plane];
  });
  if (counts.empty()) return std::nullopt;
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// A plane that divides a nonconvex face of a convex cell: through an edge beside which there is a face in the same
/// plane.
std::optional<int> plane_across_faces(const CellComplex& complex,
                                      const std::vector<std::pair<int, bool>>& faces,
                                      const std::vector<FanSide>& sides) {
  if (std::all_of(faces.begin(), faces.end(),
                  [&](const auto& face) { return complex.face(face.first).convex; }))
    return std::nullopt;
  const auto is_convex = [&](const FanSide& side) {
    return complex.face(faces[static_cast<std::size_t>(side.face)].first).convex;
  };
  std::optional<int> found;
  for_each_edge(sides, [&](const std::vector<FanSide>& around) {
    if (found || std::all_of(around.begin(), around.end(), is_convex)) return;
    if (!EdgeFan(complex, around.front().edge, around).flat()) return;
    for (const int plane : complex.edge(around.front().edge).planes)
      if (plane != around[0].plane && plane != around[1].plane) found = plane;
  });
  if (!found) throw std::logic_error("a face of a convex cell is not convex only beside one in its plane");
  return found;
}

std::optional<int> next_plane(const CellComplex& complex, int cell) {
  const std::vector<std::pair<int, bool>> faces = surface_of(complex, cell);
  const std::vector<FanSide> sides = fan_sides(complex, faces);
  if (const std::optional<int> plane = plane_through_reflex_edges(complex, sides)) return plane;
  return plane_across_faces(complex, faces, sides);
}

}  // namespace

std::vector<int> convex_parts(CellComplex& complex, int cell, int mark, int most_cells) {
  std::vector<int> convex, open = {cell};
  while (!open.empty()) {
    const int next = open.back();
    open.pop_back();
    const std::optional<int> plane = complex.convex(next) ? std::nullopt : next_plane(complex, next);
    if (!plane) {
      complex.set_convex(next);
      convex.push_back(next);
      continue;
    }
    const CellParts parts = part_cell(complex, next, *plane, mark);
    if (complex.cell_count() > most_cells)
      throw CutError("convex parts of a solid are too many (" + std::to_string(most_cells) +
                     " and more), a surface with fewer reflex edges is needed");
    for (const std::vector<int>* of : {&parts.above, &parts.below})
      open.insert(open.end(), of->begin(), of->end());
  }
  return convex;
}

}  // namespace ashlar

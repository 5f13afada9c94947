#include "geometry/cutting/small_pieces.hpp"

#include <map>
#include <set>
#include <tuple>

namespace ashlar {
namespace {

/// -1: there is none.
int nearest_neighbour(const CutSolid& solid, int piece) {
  std::map<int, double> areas;
  for (const PieceFace& face : solid.faces(piece)) {
    if (face.neighbour < 0 || solid.label(face.neighbour) != solid.label(piece)) continue;
    areas[face.neighbour] += solid.area(face);
  }
  int best = -1;
  double most = 0.0;
  for (const auto& [neighbour, area] : areas) {
    if (area <= most) continue;
    most = area;
    best = neighbour;
  }
  return best;
}

}  // namespace

int glue_small_pieces(CutSolid& solid, double volume, const CutSolid::Choice& chosen) {
  std::map<int, int> order;
  std::set<std::tuple<double, int, int>> small;  // by volume, order and number
  for (const int piece : solid.pieces()) {
    order.emplace(piece, static_cast<int>(order.size()));
    if (!chosen(piece)) continue;
    const double of_piece = solid.volume(piece);
    if (of_piece < volume) small.emplace(of_piece, order.at(piece), piece);
  }
  int glued = 0;
  while (!small.empty()) {
    const int piece = std::get<2>(*small.begin());
    small.erase(small.begin());
    const int into = nearest_neighbour(solid, piece);
    if (into < 0) continue;
    const auto before = std::tuple(solid.volume(into), order.at(into), into);
    const bool waits = small.erase(before) > 0;
    solid.glue(piece, into);
    ++glued;
    const double after = solid.volume(into);
    if (waits && after < volume) small.emplace(after, order.at(into), into);
  }
  return glued;
}

}  // namespace ashlar

// The faces of one cell around an edge, in order, exactly. Only sources of this layer include this file.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "geometry/cutting/cell_complex.hpp"

namespace ashlar {

/// One side of a face's loop, as the cell has it.
struct FanSide {
  int edge;
  int face;  ///< as the caller numbers it
  int plane;
  int sense;   ///< 1 if the face, seen from above its plane, has the edge forwards, else -1
  bool ahead;  ///< the cell is on the side to which angles increase, which is around the edge's direction
};

/// Fan sides of all faces, edge by edge. @param faces and true if the cell is below each; FanSide::face is an index
/// into them
[[nodiscard]] std::vector<FanSide> fan_sides(const CellComplex& complex,
                                             const std::vector<std::pair<int, bool>>& faces);

/// Visits the sides of each edge. @param sides edge by edge
template <class Visit>
void for_each_edge(const std::vector<FanSide>& sides, Visit visit) {
  for (auto from = sides.begin(); from != sides.end();) {
    auto to = from;
    while (to != sides.end() && to->edge == from->edge) ++to;
    visit(std::vector<FanSide>(from, to));
    from = to;
  }
}

/// The faces of a cell, with true if the cell is below each.
[[nodiscard]] std::vector<std::pair<int, bool>> surface_of(const CellComplex& complex, int cell);

class EdgeFan {
 public:
  /// @param sides of the cell around this edge, at least one
  EdgeFan(const CellComplex& complex, int edge, std::vector<FanSide> sides);

  /// By angle.
  [[nodiscard]] const std::vector<FanSide>& sides() const { return sides_; }
  /// True if the cell contains a half-plane that starts at the edge; false if that is along a face.
  [[nodiscard]] bool holds(int plane, int sense) const;
  /// The plane of a face for the division of a nonconvex part around the edge, or of parts that meet in the edge
  /// only; empty if there is one convex part.
  [[nodiscard]] std::optional<int> parting_plane() const;
  /// True if two faces are in one plane.
  [[nodiscard]] bool flat() const;

 private:
  [[nodiscard]] int turn(const FanSide& a, const FanSide& b) const;
  [[nodiscard]] int quarter(const FanSide& side) const;
  [[nodiscard]] bool before(const FanSide& a, const FanSide& b) const;

  const CellComplex& complex_;
  std::array<Integer, 3> along_;
  FanSide first_;
  std::vector<FanSide> sides_;
};

}  // namespace ashlar

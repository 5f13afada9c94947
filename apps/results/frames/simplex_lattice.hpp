// Points between the corners of triangles and tetrahedra, shared by neighbours on common sides.
//
// A lattice point of order n has an integer weight >= 0 for each corner, with sum n. It is the mean of the corners
// with these weights.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace ashlar {

/// @tparam corners 3: triangles, 4: tetrahedra
template <std::size_t corners>
struct SimplexLattice {
  using Weights = std::array<int, corners>;
  /// Position of a point; for a shared one in the first cell that has it.
  struct Point {
    std::size_t cell;
    Weights weights;
  };
  std::vector<Point> points;            ///< in the order of their first use
  std::vector<std::vector<int>> nodes;  ///< (#cells) indices into `points`, in the order of the weights given
};

/// @param cells corners of each; equal numbers mean the same corner. @param weights of the points of each cell
template <std::size_t corners>
[[nodiscard]] SimplexLattice<corners> simplex_lattice(const std::vector<std::array<int, corners>>& cells,
                                                      const std::vector<std::array<int, corners>>& weights) {
  // Corners with their weights in a point: the same in every cell that has it.
  using Key = std::array<std::pair<int, int>, corners>;
  SimplexLattice<corners> lattice;
  std::map<Key, int> known;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    std::vector<int>& nodes = lattice.nodes.emplace_back();
    for (const auto& node : weights) {
      int index = static_cast<int>(lattice.points.size());
      if (*std::min_element(node.begin(), node.end()) == 0) {
        Key key;
        for (std::size_t k = 0; k < corners; ++k)
          key[k] = node[k] == 0 ? std::pair(-1, 0) : std::pair(cells[c][k], node[k]);
        std::sort(key.begin(), key.end());
        index = known.try_emplace(key, index).first->second;
      }
      if (index == static_cast<int>(lattice.points.size())) lattice.points.push_back({c, node});
      nodes.push_back(index);
    }
  }
  return lattice;
}

}  // namespace ashlar

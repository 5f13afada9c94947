#include "geometry/solid/mesh_edges.hpp"

#include <algorithm>
#include <tuple>

namespace ashlar {

std::vector<EdgeUse> sorted_edge_uses(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (a == b || b == c || c == a) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
      uses.push_back(
          {(static_cast<std::uint64_t>(low) << 32U) | static_cast<std::uint64_t>(high), 3 * t + k});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& x, const EdgeUse& y) {
    return std::tie(x.edge, x.halfedge) < std::tie(y.edge, y.halfedge);
  });
  return uses;
}

}  // namespace ashlar

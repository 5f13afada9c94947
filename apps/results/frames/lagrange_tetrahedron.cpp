#include "apps/results/frames/lagrange_tetrahedron.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "apps/results/frames/lagrange_triangle.hpp"

namespace ashlar {
namespace {

/// Adds the inner nodes of a face, as a triangle of its own.
void add_face(std::vector<TetrahedronWeights>& nodes, int order, int inset,
              const std::array<std::size_t, 3>& corners) {
  if (order < 3) return;
  const std::vector<LatticeWeights> middle = {{0, 0, 0}};
  for (const LatticeWeights& inner : order == 3 ? middle : lagrange_nodes(order - 3)) {
    TetrahedronWeights node;
    node.fill(inset);
    for (std::size_t k = 0; k < 3; ++k) node[corners[k]] += 1 + inner[k];
    nodes.push_back(node);
  }
}

void add_side(std::vector<TetrahedronWeights>& nodes, int order, int inset, std::size_t from,
              std::size_t to) {
  for (int k = 1; k < order; ++k) {
    TetrahedronWeights node;
    node.fill(inset);
    node[from] += order - k;
    node[to] += k;
    nodes.push_back(node);
  }
}

/// The corners of Kuhn's tetrahedra of a unit cube: along the axes in each order, with odd orders reversed.
constexpr std::array<std::array<int, 3>, 6> axis_orders = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};

}  // namespace

std::vector<TetrahedronWeights> tetrahedron_nodes(int order) {
  if (order < 1) throw std::invalid_argument("a Lagrange tetrahedron needs order 1 or more");
  std::vector<TetrahedronWeights> nodes;
  // `inset`: number of lattice planes between a point and the nearest face.
  for (int inset = 0; 4 * inset <= order; ++inset) {
    const int n = order - 4 * inset;
    if (n == 0) {
      nodes.push_back({inset, inset, inset, inset});
      break;
    }
    for (std::size_t corner = 0; corner < 4; ++corner) {
      TetrahedronWeights node;
      node.fill(inset);
      node[corner] += n;
      nodes.push_back(node);
    }
    for (const auto& [from, to] : {std::array<std::size_t, 2>{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}})
      add_side(nodes, n, inset, from, to);
    for (const auto& face : {std::array<std::size_t, 3>{0, 1, 3}, {2, 3, 1}, {0, 3, 2}, {0, 2, 1}})
      add_face(nodes, n, inset, face);
  }
  return nodes;
}

std::vector<std::array<int, 4>> lattice_tetrahedra(int pieces) {
  std::map<TetrahedronWeights, int> index;
  for (const TetrahedronWeights& node : tetrahedron_nodes(pieces))
    index.emplace(node, static_cast<int>(index.size()));
  std::vector<std::array<int, 4>> cells;
  // The large one is the corner pieces >= x >= y >= z >= 0 of a cube with the weights p - x, x - y, y - z, z.
  const auto add = [&](std::array<int, 3> place, const std::array<int, 3>& axes, bool odd) {
    std::array<int, 4> cell{};
    for (std::size_t k = 0; k < 4; ++k) {
      if (k > 0) ++place[static_cast<std::size_t>(axes[k - 1])];
      const auto& [x, y, z] = place;
      const auto found = index.find({pieces - x, x - y, y - z, z});
      if (found == index.end()) return;
      cell[k] = found->second;
    }
    if (odd) std::swap(cell[2], cell[3]);
    cells.push_back(cell);
  };
  for (int x = 0; x < pieces; ++x)
    for (int y = 0; y <= x; ++y)
      for (int z = 0; z <= y; ++z)
        for (std::size_t k = 0; k < axis_orders.size(); ++k) add({x, y, z}, axis_orders[k], k >= 3);
  return cells;
}

}  // namespace ashlar

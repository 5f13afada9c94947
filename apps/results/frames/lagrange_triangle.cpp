#include "apps/results/frames/lagrange_triangle.hpp"

#include <map>
#include <stdexcept>
#include <utility>

namespace ashlar {
namespace {

double binomial(double z, int count) {
  double value = 1.0;
  for (int j = 0; j < count; ++j) value *= (z - j) / (j + 1);
  return value;
}

}  // namespace

std::vector<LatticeWeights> lagrange_nodes(int order) {
  if (order < 1) throw std::invalid_argument("a Lagrange triangle needs order 1 or more");
  std::vector<LatticeWeights> nodes;
  // `ring`: number of lattice lines between a point and the nearest side.
  for (int ring = 0; 3 * ring <= order; ++ring) {
    const int n = order - 3 * ring;
    const auto add = [&](int i, int j, int k) { nodes.push_back({ring + i, ring + j, ring + k}); };
    if (n == 0) {
      add(0, 0, 0);
      break;
    }
    add(n, 0, 0);
    add(0, n, 0);
    add(0, 0, n);
    for (int k = 1; k < n; ++k) add(n - k, k, 0);
    for (int k = 1; k < n; ++k) add(0, n - k, k);
    for (int k = 1; k < n; ++k) add(k, 0, n - k);
  }
  return nodes;
}

std::vector<double> lagrange_values(int order, const std::array<double, 3>& share) {
  std::vector<double> values;
  for (const LatticeWeights& weights : lagrange_nodes(order)) {
    double value = 1.0;
    for (std::size_t k = 0; k < 3; ++k) value *= binomial(order * share[k], weights[k]);
    values.push_back(value);
  }
  return values;
}

std::vector<std::array<int, 3>> lattice_triangles(int order) {
  const std::vector<LatticeWeights> nodes = lagrange_nodes(order);
  std::map<std::pair<int, int>, int> index;  // by the weights of B and C
  for (const LatticeWeights& weights : nodes)
    index.emplace(std::pair(weights[1], weights[2]), static_cast<int>(index.size()));
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j < order; ++j) {
    for (int k = 0; j + k < order; ++k) {
      triangles.push_back({index.at({j, k}), index.at({j + 1, k}), index.at({j, k + 1})});
      if (j + k + 1 < order)
        triangles.push_back({index.at({j + 1, k}), index.at({j + 1, k + 1}), index.at({j, k + 1})});
    }
  }
  return triangles;
}

SharedLattice shared_lattice(const std::vector<std::array<int, 3>>& corners, int order) {
  return simplex_lattice(corners, lagrange_nodes(order));
}

}  // namespace ashlar

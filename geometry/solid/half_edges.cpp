#include "geometry/solid/half_edges.hpp"

#include <algorithm>
#include <tuple>

namespace ashlar {

void HalfEdges::add(int triangle) {
  for (int h = 3 * triangle; h < 3 * triangle + 3; ++h) {
    int& head = first_[start(h)];
    next_[h] = head;
    head = h;
  }
}

void HalfEdges::add_all() {
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
    const auto& [a, b, c] = triangles_[t];
    if (a != b && b != c && c != a) add(t);
  }
}

void HalfEdges::remove(int triangle) {
  for (int h = 3 * triangle; h < 3 * triangle + 3; ++h) {
    int* link = &first_[start(h)];
    while (*link != h) link = &next_[*link];
    *link = next_[h];
  }
}

// The half-edges that end at a point precede those that start from it in their triangles.
std::vector<int> HalfEdges::sorted_by_edge() const {
  struct Use {
    int high, h;
  };
  std::vector<Use> uses;  // of edges whose smaller end is one point
  std::vector<int> sorted;
  sorted.reserve(next_.size());
  for (int low = 0; low < static_cast<int>(first_.size()); ++low) {
    uses.clear();
    for (int h = first_[low]; h >= 0; h = next_[h]) {
      const int before = previous_half_edge(h);
      if (end(h) > low) uses.push_back({end(h), h});
      if (start(before) > low) uses.push_back({start(before), before});
    }
    std::sort(uses.begin(), uses.end(),
              [](const Use& x, const Use& y) { return std::tie(x.high, x.h) < std::tie(y.high, y.h); });
    for (const Use& use : uses) sorted.push_back(use.h);
  }
  return sorted;
}

std::vector<int> HalfEdges::twins(const std::vector<int>& sorted) const {
  std::vector<int> twins(next_.size(), -1);
  for_each_edge(sorted, [&](std::span<const int> edge) {
    if (edge.size() != 2 || start(edge[0]) == start(edge[1])) return;
    twins[edge[0]] = edge[1];
    twins[edge[1]] = edge[0];
  });
  return twins;
}

}  // namespace ashlar

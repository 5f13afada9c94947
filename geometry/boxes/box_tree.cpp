#include "geometry/boxes/box_tree.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace ashlar {

BoxTree::BoxTree(std::vector<Box> boxes, int leaf_size) : boxes_(std::move(boxes)), items_(boxes_.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  if (items_.empty()) return;
  nodes_.reserve(2 * boxes_.size());
  nodes_.push_back({{}, -1, 0, static_cast<int>(items_.size())});
  for (std::size_t n = 0; n < nodes_.size(); ++n) split(static_cast<int>(n), leaf_size);
}

std::vector<int> BoxTree::meeting(const Box& around) const {
  std::vector<int> found;
  std::vector<int> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (!node.box.meets(around)) continue;
    if (node.children >= 0) {
      open.insert(open.end(), {node.children, node.children + 1});
      continue;
    }
    for (int k = node.begin; k < node.end; ++k)
      if (boxes_[items_[k]].meets(around)) found.push_back(items_[k]);
  }
  std::sort(found.begin(), found.end());
  return found;
}

void BoxTree::split(int node, int leaf_size) {
  const int begin = nodes_[node].begin, end = nodes_[node].end;
  Box centers;
  const auto center = [this](int item) -> Vector3 {
    return 0.5 * boxes_[item].low + 0.5 * boxes_[item].high;
  };
  for (int i = begin; i < end; ++i) {
    nodes_[node].box.include(boxes_[items_[i]]);
    centers.include(center(items_[i]));
  }
  if (end - begin <= leaf_size) return;
  int axis = 0;
  (centers.high - centers.low).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end, [&](int x, int y) {
    const double p = center(x)[axis], q = center(y)[axis];
    return p < q || (p == q && x < y);
  });
  nodes_[node].children = static_cast<int>(nodes_.size());
  nodes_.push_back({{}, -1, begin, middle});
  nodes_.push_back({{}, -1, middle, end});
}

PackedBoxTree::PackedBoxTree(const BoxTree& tree) {
  const auto& nodes = tree.nodes();
  if (nodes.empty()) return;
  // The tree's node that becomes a packed one, or -1 - the position of an item.
  std::vector<int> roots{0};
  for (std::size_t n = 0; n < roots.size(); ++n) {
    // Nodes are divided, largest first, until there are four.
    std::vector<int> open{roots[n]};
    const auto items = [&](int i) { return nodes[i].end - nodes[i].begin; };
    const auto by_items = [&](int i, int k) { return items(i) < items(k); };
    while (static_cast<int>(open.size()) < width) {
      const auto largest = std::max_element(open.begin(), open.end(), by_items);
      const int children = nodes[*largest].children;
      if (children < 0) break;
      *largest = children;
      open.push_back(children + 1);
    }
    Node& node = nodes_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) node.low[i] = node.high[i] = Lanes::Zero();
    for (const int child : open) {
      const auto lane = static_cast<std::size_t>(node.count++);
      for (Eigen::Index i = 0; i < 3; ++i) {
        node.low[static_cast<std::size_t>(i)][static_cast<Eigen::Index>(lane)] = nodes[child].box.low[i];
        node.high[static_cast<std::size_t>(i)][static_cast<Eigen::Index>(lane)] = nodes[child].box.high[i];
      }
      if (nodes[child].children < 0) {
        if (items(child) != 1) throw std::invalid_argument("box tree: a leaf has several boxes");
        node.children[lane] = -1 - nodes[child].begin;
      } else {
        node.children[lane] = static_cast<int>(roots.size());
        roots.push_back(child);
      }
    }
  }
}

}  // namespace ashlar

#include "geometry/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace ashlar {

BoxTree::BoxTree(std::vector<Box> boxes, int leaf_size) : boxes_(std::move(boxes)), items_(boxes_.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  if (items_.empty()) return;
  nodes_.reserve(boxes_.size());
  nodes_.push_back({{}, -1, 0, static_cast<int>(items_.size())});
  for (std::size_t n = 0; n < nodes_.size(); ++n) split(static_cast<int>(n), leaf_size);
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

}  // namespace ashlar

// A tree of boxes, for the parts of two surfaces that can be near each other.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/boxes/box.hpp"

namespace ashlar {

/// Rounded. Every coordinate of the gap is rounded once, and so are three squares and two sums: its relative
/// error is below 4 * 2^-52. Zero only if the boxes meet, or by underflow.
[[nodiscard]] inline double squared_distance(const Box& a, const Box& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0).squaredNorm();
}

/// True only if boxes of that rounded squared distance are farther apart than a bound of squared distances; products
/// of the smallest numbers are undecided.
[[nodiscard]] inline bool is_certainly_farther(double squared_distance, double bound) {
  constexpr double rounding = 1.0 - 0x1p-49;
  return squared_distance > std::numeric_limits<double>::min() && squared_distance * rounding > bound;
}

/// A balanced binary tree over boxes, split at medians of the longest side. Constant after construction.
class BoxTree {
 public:
  struct Node {
    Box box;
    int children = -1;       ///< the first of two that follow each other; -1: a leaf
    int begin = 0, end = 0;  ///< of its items in items()
  };

  explicit BoxTree(std::vector<Box> boxes, int leaf_size = 4);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// Indices of the boxes, those of a node together.
  [[nodiscard]] const std::vector<int>& items() const { return items_; }
  [[nodiscard]] const Box& box(int item) const { return boxes_[item]; }
  /// Boxes that meet a given one, ascending.
  [[nodiscard]] std::vector<int> meeting(const Box& around) const;

 private:
  void split(int node, int leaf_size);

  std::vector<Box> boxes_;
  std::vector<Node> nodes_;
  std::vector<int> items_;
};

/// The boxes of one tree for queries of points: up to four boxes a node, compared with a point at once.
/// Constant after construction.
class PackedBoxTree {
 public:
  /// @throws std::invalid_argument for a tree with more than one box in a leaf.
  explicit PackedBoxTree(const BoxTree& tree);

  /// Calls visit(position in tree.items()) for all boxes that are not certainly farther from a point than bound(), a
  /// squared distance that may decrease from call to call, approximately in order of distance.
  template <class Bound, class Visit>
  void for_each_near(const Eigen::Vector3d& x, Bound bound, Visit visit) const;

 private:
  static constexpr int width = 4;
  using Lanes = Eigen::Array<double, width, 1>;
  struct Node {
    std::array<Lanes, 3> low, high;   ///< by axis
    std::array<int, width> children;  ///< a node, or -1 - a position in tree.items()
    int count = 0;                    ///< of its boxes; the rest are points at the origin
  };

  [[nodiscard]] static Lanes squared_distances(const Node& node, const Eigen::Vector3d& x) {
    Lanes sum = Lanes::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const double at = x[static_cast<Eigen::Index>(i)];
      sum += (node.low[i] - at).max(at - node.high[i]).max(0.0).square();
    }
    return sum;
  }

  std::vector<Node> nodes_;
};

template <class Bound, class Visit>
void PackedBoxTree::for_each_near(const Eigen::Vector3d& x, Bound bound, Visit visit) const {
  struct Open {
    double distance;
    int child;
  };
  if (nodes_.empty()) return;
  std::array<Open, 128> stack;  // the tree is balanced: three entries a level, and one
  std::size_t size = 0;
  stack[size++] = {0.0, 0};
  while (size > 0) {
    const Open open = stack[--size];
    if (is_certainly_farther(open.distance, bound())) continue;
    if (open.child < 0) {
      visit(-1 - open.child);
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(open.child)];
    const Lanes distances = squared_distances(node, x);
    const double limit = bound();
    const std::size_t first = size;
    for (int lane = 0; lane < node.count; ++lane) {
      const double distance = distances[lane];
      if (is_certainly_farther(distance, limit)) continue;
      std::size_t place = size++;  // the nearest last
      for (; place > first && stack[place - 1].distance < distance; --place) stack[place] = stack[place - 1];
      stack[place] = {distance, node.children[static_cast<std::size_t>(lane)]};
    }
  }
}

/// Calls visit(item of a, item of b) for all pairs that are not certainly farther apart than bound(), a squared
/// distance that may decrease from call to call, approximately in order of distance. Ends when a call returns false.
/// @return false if one did.
template <class Bound, class Visit>
bool for_each_near_pair(const BoxTree& a, const BoxTree& b, Bound bound, Visit visit) {
  struct Pair {
    int a, b;
    double distance;
  };
  std::vector<Pair> open;
  const auto push = [&](int i, int k) {
    const double distance = squared_distance(a.nodes()[i].box, b.nodes()[k].box);
    if (!is_certainly_farther(distance, bound())) open.push_back({i, k, distance});
  };
  if (a.items().empty() || b.items().empty()) return true;
  push(0, 0);
  while (!open.empty()) {
    const Pair pair = open.back();
    open.pop_back();
    if (is_certainly_farther(pair.distance, bound())) continue;
    const BoxTree::Node &of_a = a.nodes()[pair.a], &of_b = b.nodes()[pair.b];
    if (of_a.children < 0 && of_b.children < 0) {
      for (int i = of_a.begin; i < of_a.end; ++i)
        for (int k = of_b.begin; k < of_b.end; ++k) {
          const int x = a.items()[i], y = b.items()[k];
          if (is_certainly_farther(squared_distance(a.box(x), b.box(y)), bound())) continue;
          if (!visit(x, y)) return false;
        }
      continue;
    }
    const bool divide_a =
        of_b.children < 0 || (of_a.children >= 0 && of_a.end - of_a.begin >= of_b.end - of_b.begin);
    const std::size_t before = open.size();
    for (int c = 0; c < 2; ++c) {
      if (divide_a)
        push(of_a.children + c, pair.b);
      else
        push(pair.a, of_b.children + c);
    }
    if (open.size() == before + 2 && open[before].distance < open[before + 1].distance)
      std::swap(open[before], open[before + 1]);
  }
  return true;
}

}  // namespace ashlar

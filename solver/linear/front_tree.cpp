#include "solver/linear/front_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

constexpr int widest_panel = 96;
constexpr std::size_t values_in_line =
    16;  ///< panels and updates start at cache lines, in single precision too
/// A part of the tree is a task up to this share of all operations.
constexpr double part_share = 1.0 / 64.0;
/// Multiplications from which on a front near a root is shared: less takes less than 0.3 ms.
constexpr double shared_work = 4e6;

std::size_t in_lines(std::size_t values) {
  return (values + values_in_line - 1) / values_in_line * values_in_line;
}

/// The elimination of single blocks in an order.
struct Elimination {
  std::vector<int> parent;              ///< by place; -1: none
  std::vector<std::vector<int>> below;  ///< places of the blocks below, increasing
};

std::vector<int> places_of(const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[at(order[k])] = static_cast<int>(k);
  return place;
}

Elimination eliminate(const BlockGraph& graph, const std::vector<int>& order) {
  const std::vector<int> place = places_of(order);
  Elimination result{std::vector<int>(order.size(), -1), std::vector<std::vector<int>>(order.size())};
  std::vector<std::vector<int>> children(order.size());
  std::vector<int> seen(order.size(), -1);
  for (int j = 0; j < graph.blocks(); ++j) {
    std::vector<int>& below = result.below[at(j)];
    const auto add = [&](int other) {
      if (other <= j || seen[at(other)] == j) return;
      seen[at(other)] = j;
      below.push_back(other);
    };
    for (const int block : graph.of(order[at(j)])) add(place[at(block)]);
    for (const int child : children[at(j)])
      for (const int other : result.below[at(child)]) add(other);
    std::sort(below.begin(), below.end());
    if (below.empty()) continue;
    result.parent[at(j)] = below.front();
    children[at(below.front())].push_back(j);
  }
  return result;
}

/// Places such that each block follows its descendants at once.
std::vector<int> postorder(const std::vector<int>& parent) {
  const int blocks = static_cast<int>(parent.size());
  std::vector<std::vector<int>> children(parent.size());
  std::vector<int> roots;
  for (int j = 0; j < blocks; ++j) (parent[at(j)] < 0 ? roots : children[at(parent[at(j)])]).push_back(j);
  std::vector<int> result;
  std::vector<std::pair<int, std::size_t>> path;  // with the next child of each
  for (const int root : roots) {
    path.emplace_back(root, 0);
    while (!path.empty()) {
      auto& [j, next] = path.back();
      if (next < children[at(j)].size()) {
        path.emplace_back(children[at(j)][next++], 0);
        continue;
      }
      result.push_back(j);
      path.pop_back();
    }
  }
  return result;
}

/// Blocks of a front while fronts are merged.
struct Supernode {
  int first, last;
  double entries;  ///< blocks of the factor without zeros that merging adds
};

bool is_worth_merging(double blocks, double zeros) {
  return zeros <= 0.05 || (blocks <= 4.0 && zeros <= 0.15) || (blocks <= 2.0 && zeros <= 0.4);
}

/// Merges fronts with their parents where the share of zeros remains small (Ashcraft and Grimes 1989).
std::vector<Supernode> merged_fronts(const Elimination& elimination) {
  std::vector<Supernode> nodes;
  for (int j = 0; j < static_cast<int>(elimination.parent.size()); ++j) {
    const double below = static_cast<double>(elimination.below[at(j)].size());
    Supernode node{j, j, 1.0 + below};
    while (!nodes.empty()) {
      const Supernode& child = nodes.back();
      // The child's lowest block below must be in this front.
      const int parent = elimination.parent[at(child.last)];
      if (parent < node.first || parent > node.last) break;
      const double blocks = node.last - child.first + 1;
      const double all = blocks * (blocks + 1.0) / 2.0 + blocks * below;
      const double entries = node.entries + child.entries;
      if (!is_worth_merging(blocks, (all - entries) / all)) break;
      node = {child.first, j, entries};
      nodes.pop_back();
    }
    nodes.push_back(node);
  }
  return nodes;
}

std::vector<FrontPanel> panels_of(int pivots, int size, std::size_t& values) {
  std::vector<FrontPanel> panels;
  const int count = (pivots + widest_panel - 1) / widest_panel;
  for (int k = 0; k < count; ++k) {
    const int start = pivots * k / count;
    const int width = pivots * (k + 1) / count - start;
    panels.push_back({start, width, size - start, values});
    values += in_lines(static_cast<std::size_t>(width) * static_cast<std::size_t>(size - start));
  }
  return panels;
}

class TreeBuilder {
 public:
  TreeBuilder(const SymmetricMatrix& matrix, const BlockGraph& graph) : matrix_(matrix), graph_(graph) {}

  FrontTree build() {
    const std::vector<int> dissected = nested_dissection(graph_);
    for (const int place : postorder(eliminate(graph_, dissected).parent))
      tree_.order.push_back(dissected[at(place)]);
    place_ = places_of(tree_.order);
    std::vector<int> sizes;
    for (const int block : tree_.order) sizes.push_back(graph_.sizes[at(block)]);
    tree_.start = first_unknowns(sizes);
    make_fronts(eliminate(graph_, tree_.order));
    for (Front& front : tree_.fronts) {
      add_blocks(front);
      add_runs(front);
    }
    divide();
    place_updates();
    return std::move(tree_);
  }

 private:
  void make_fronts(const Elimination& elimination) {
    std::vector<int> front_of(tree_.order.size());
    for (const Supernode& node : merged_fronts(elimination)) {
      const int k = static_cast<int>(tree_.fronts.size());
      Front& front =
          tree_.fronts.emplace_back(Front{node.first, node.last, elimination.below[at(node.last)]});
      for (int j = node.first; j <= node.last; ++j) front_of[at(j)] = k;
      front.start = tree_.start[at(node.first)];
      front.pivots = tree_.start[at(node.last) + 1] - front.start;
      for (const int j : front.blocks_below) front.below += tree_.start[at(j) + 1] - tree_.start[at(j)];
      front.panels = panels_of(front.pivots, front.size(), tree_.panel_values);
      for (int j = 0; j < front.pivots; ++j) {
        const double rows = front.size() - j;
        front.work += rows * rows;
        tree_.entries += static_cast<std::size_t>(front.size() - j);
      }
      tree_.work += front.work;
      tree_.largest_front = std::max(tree_.largest_front, front.size());
      front.vector = tree_.vector_values;
      tree_.vector_values += in_lines(at(front.size()));
    }
    for (std::size_t k = 0; k < tree_.fronts.size(); ++k) {
      Front& front = tree_.fronts[k];
      front.subtree_work += front.work;
      if (front.blocks_below.empty()) continue;
      front.parent = front_of[at(front.blocks_below.front())];
      tree_.fronts[at(front.parent)].children.push_back(static_cast<int>(k));
      tree_.fronts[at(front.parent)].subtree_work += front.subtree_work;
    }
  }

  /// First row of each block of a front.
  [[nodiscard]] std::vector<int> rows_of_below(const Front& front) const {
    std::vector<int> rows;
    int row = front.pivots;
    for (const int j : front.blocks_below) {
      rows.push_back(row);
      row += tree_.start[at(j) + 1] - tree_.start[at(j)];
    }
    return rows;
  }
  /// Row of the first unknown of a block in a front. @param rows as of rows_of_below()
  [[nodiscard]] int row_of(const Front& front, const std::vector<int>& rows, int j) const {
    if (j <= front.last_block) return tree_.start[at(j)] - front.start;
    const auto found = std::lower_bound(front.blocks_below.begin(), front.blocks_below.end(), j);
    return rows[static_cast<std::size_t>(found - front.blocks_below.begin())];
  }

  void add_blocks(Front& front) const {
    const std::vector<int> rows = rows_of_below(front);
    const std::vector<int> first = first_unknowns(graph_.sizes);
    for (int j = front.first_block; j <= front.last_block; ++j) {
      const int block = tree_.order[at(j)];
      const int size = graph_.sizes[at(block)];
      const int column = tree_.start[at(j)] - front.start;
      if (size > 0) front.blocks.push_back({column, column, first[at(block)], 0, size, size, false});
      for (const int other : graph_.of(block)) {
        if (place_[at(other)] < j) continue;
        const bool transposed = other < block;  // it is a block of the other's columns
        const int own = transposed ? other : block;
        const int row_block = transposed ? block : other;
        const int row = row_of(front, rows, place_[at(other)]);
        front.blocks.push_back({row, column, first[at(own)], place_in_column(own, row_block, first),
                                graph_.sizes[at(row_block)], graph_.sizes[at(own)], transposed});
      }
    }
  }
  /// Place of the first row of a block in the rows of the first column of another one.
  [[nodiscard]] int place_in_column(int column_block, int row_block, const std::vector<int>& first) const {
    const auto begin = matrix_.rows.begin() + matrix_.column_start[at(first[at(column_block)])];
    const auto end = matrix_.rows.begin() + matrix_.column_start[at(first[at(column_block)]) + 1];
    return static_cast<int>(std::lower_bound(begin, end, first[at(row_block)]) - begin);
  }

  void add_runs(Front& front) const {
    const auto add = [](std::vector<RowRun>& runs, int from, int to, int length) {
      if (length == 0) return;
      if (!runs.empty() && runs.back().from + runs.back().length == from &&
          runs.back().to + runs.back().length == to)
        runs.back().length += length;
      else
        runs.push_back({from, to, length});
    };
    const Front* parent = front.parent < 0 ? nullptr : &tree_.fronts[at(front.parent)];
    const std::vector<int> rows = parent == nullptr ? std::vector<int>() : rows_of_below(*parent);
    int from = 0;
    for (const int j : front.blocks_below) {
      const int length = tree_.start[at(j) + 1] - tree_.start[at(j)];
      add(front.in_vector, from, tree_.start[at(j)], length);
      add(front.in_parent, from, row_of(*parent, rows, j), length);
      from += length;
    }
  }

  /// Divides the fronts into parts. Those above a part's share of operations are parts of their own.
  void divide() {
    const double most = part_share * tree_.work;
    const auto is_upper = [&](int k) { return k < 0 || tree_.fronts[at(k)].subtree_work > most; };
    double gathered = 0.0;
    bool open = false;  // the last part may get another subtree
    for (int k = 0; k < static_cast<int>(tree_.fronts.size()); ++k) {
      const Front& front = tree_.fronts[at(k)];
      if (is_upper(k)) {
        tree_.parts.push_back({k, k, front.work >= shared_work});
        open = false;
        continue;
      }
      if (!open) {
        tree_.parts.push_back({k, k, false});
        gathered = 0.0;
      }
      tree_.parts.back().last = k;
      gathered += front.work;
      // A subtree ends where the parent is above.
      open = !is_upper(front.parent) || gathered < 0.5 * most;
    }
  }

  /// An update is needed until the parent's front is assembled. Within a task, updates of even and odd depth have a stack
  /// each, so that those of the children are on top of the other stack when a front makes its own.
  void place_updates() {
    std::vector<int> depth(tree_.fronts.size(), 0);
    for (std::size_t k = tree_.fronts.size(); k-- > 0;) {
      const int parent = tree_.fronts[k].parent;
      if (parent >= 0) depth[k] = depth[at(parent)] + 1;
    }
    for (const TreePart& part : tree_.parts) {
      std::array<std::size_t, 2> top = {0, 0};
      for (int k = part.first; k <= part.last; ++k) {
        Front& front = tree_.fronts[at(k)];
        front.kept = front.parent > part.last;
        front.stack = depth[at(k)] % 2;
        std::size_t& next = front.kept ? tree_.kept_values : top[at(front.stack)];
        front.update = next;
        next += in_lines(at(front.below) * at(front.below));
        for (std::size_t stack = 0; stack < 2; ++stack)
          tree_.stack_values[stack] = std::max(tree_.stack_values[stack], top[stack]);
        for (const int child : front.children)
          if (!tree_.fronts[at(child)].kept) {
            top[at(1 - front.stack)] = tree_.fronts[at(child)].update;
            break;  // the first of them lies lowest
          }
      }
    }
  }

  const SymmetricMatrix& matrix_;
  const BlockGraph& graph_;
  std::vector<int> place_;  ///< in the order, of each block
  FrontTree tree_;
};

}  // namespace

FrontTree make_front_tree(const SymmetricMatrix& matrix, const std::vector<int>& sizes) {
  const BlockGraph graph = graph_of(matrix, sizes);
  return TreeBuilder(matrix, graph).build();
}

}  // namespace ashlar

#include "solver/linear/block_graph.hpp"

#include <cholmod.h>

#include <algorithm>
#include <new>
#include <numeric>
#include <stdexcept>

#include "geometry/index.hpp"
#include "solver/linear/metis_use.hpp"

namespace ashlar {

std::span<const int> BlockGraph::of(int block) const {
  return {neighbours.data() + start[at(block)], neighbours.data() + start[at(block) + 1]};
}

std::vector<int> first_unknowns(const std::vector<int>& sizes) {
  std::vector<int> first(sizes.size() + 1, 0);
  std::partial_sum(sizes.begin(), sizes.end(), first.begin() + 1);
  return first;
}

namespace {

/// Blocks below the diagonal block in a column. @throws std::invalid_argument unless they are dense
std::vector<int> blocks_below(const SymmetricMatrix& matrix, const std::vector<int>& first,
                              const std::vector<int>& block_of, int column) {
  const int own = block_of[at(column)];
  const int* row = matrix.rows.data() + matrix.column_start[at(column)];
  const int* const end = matrix.rows.data() + matrix.column_start[at(column) + 1];
  std::vector<int> below;
  const auto skip = [&](int from, int to) {
    for (int k = from; k < to; ++k, ++row)
      if (row == end || *row != k) throw std::invalid_argument("the blocks of a matrix are not dense");
  };
  skip(column, first[at(own) + 1]);
  while (row != end) {
    const int block = block_of[at(*row)];
    skip(first[at(block)], first[at(block) + 1]);
    below.push_back(block);
  }
  return below;
}

}  // namespace

BlockGraph graph_of(const SymmetricMatrix& matrix, std::vector<int> sizes) {
  const std::vector<int> first = first_unknowns(sizes);
  if (first.back() != matrix.size) throw std::invalid_argument("blocks and matrix differ in size");
  std::vector<int> block_of(at(matrix.size));
  for (std::size_t k = 0; k < sizes.size(); ++k)
    std::fill(block_of.begin() + first[k], block_of.begin() + first[k + 1], static_cast<int>(k));
  std::vector<std::vector<int>> all(sizes.size());
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    if (sizes[k] == 0) continue;
    const std::vector<int> below = blocks_below(matrix, first, block_of, first[k]);
    for (int column = first[k] + 1; column < first[k + 1]; ++column)
      if (blocks_below(matrix, first, block_of, column) != below)
        throw std::invalid_argument("the columns of a block differ in their rows");
    for (const int other : below) {
      all[k].push_back(other);
      all[at(other)].push_back(static_cast<int>(k));
    }
  }
  BlockGraph graph{std::move(sizes), {0}, {}};
  for (std::vector<int>& neighbours : all) {
    std::sort(neighbours.begin(), neighbours.end());
    graph.neighbours.insert(graph.neighbours.end(), neighbours.begin(), neighbours.end());
    graph.start.push_back(static_cast<int>(graph.neighbours.size()));
  }
  return graph;
}

std::vector<int> nested_dissection(const BlockGraph& graph) {
  std::vector<int> lower_start = {0};
  std::vector<int> lower;
  for (int k = 0; k < graph.blocks(); ++k) {
    for (const int other : graph.of(k))
      if (other > k) lower.push_back(other);
    lower_start.push_back(static_cast<int>(lower.size()));
  }
  std::vector<int> order(at(graph.blocks()));
  std::iota(order.begin(), order.end(), 0);
  if (lower.empty()) return order;
  cholmod_sparse pattern{};
  pattern.nrow = pattern.ncol = order.size();
  pattern.nzmax = lower.size();
  pattern.p = lower_start.data();
  pattern.i = lower.data();
  pattern.stype = -1;
  pattern.itype = CHOLMOD_INT;
  pattern.xtype = CHOLMOD_PATTERN;
  pattern.dtype = CHOLMOD_DOUBLE;
  pattern.sorted = pattern.packed = 1;
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  const bool done = [&] {
    const MetisUse use;
    return cholmod_metis(&pattern, nullptr, 0, 0, order.data(), &common) != 0;
  }();
  cholmod_finish(&common);
  if (!done) throw std::bad_alloc();
  return order;
}

}  // namespace ashlar

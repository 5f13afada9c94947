// The graph of a matrix of dense blocks, and an order of its blocks in which a factor of the matrix has few entries.
#pragma once

#include <span>
#include <vector>

#include "solver/linear/linear_solver.hpp"

namespace ashlar {

/// Blocks are joined where the matrix has an entry. Each pair is listed for both blocks.
struct BlockGraph {
  std::vector<int> sizes;       ///< unknowns of each block
  std::vector<int> start;       ///< (#blocks + 1) into `neighbours`
  std::vector<int> neighbours;  ///< of each block, increasing

  [[nodiscard]] int blocks() const { return static_cast<int>(sizes.size()); }
  [[nodiscard]] std::span<const int> of(int block) const;
};

/// First unknown of each block, and the number of unknowns.
[[nodiscard]] std::vector<int> first_unknowns(const std::vector<int>& sizes);

/// @param sizes unknowns of each block, >= 0, whose sum is the size of the matrix
/// @throws std::invalid_argument unless the matrix consists of dense blocks of these sizes
[[nodiscard]] BlockGraph graph_of(const SymmetricMatrix& matrix, std::vector<int> sizes);

/// Nested dissection by METIS, of blocks as if they had equal sizes. Depends on the graph only.
/// @return block at each place. @throws std::bad_alloc
[[nodiscard]] std::vector<int> nested_dissection(const BlockGraph& graph);

}  // namespace ashlar

// The tree of fronts of a multifrontal Cholesky factor of a matrix of dense blocks: which blocks are eliminated together,
// where their values are stored, and which parts of the tree are tasks. All of it depends on the pattern only.
//
// A front is a dense symmetric matrix over the unknowns of its pivot blocks, which it eliminates, followed by those of the
// blocks below, to which they are coupled. What remains of the blocks below, its update, is added to the parent's front.
//   I. S. Duff, J. K. Reid, The multifrontal solution of indefinite sparse symmetric linear equations, ACM TOMS 9 (1983) 302.
//   C. Ashcraft, R. Grimes, The influence of relaxed supernode partitions on the multifrontal method, ACM TOMS 15 (1989) 291.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/linear/block_graph.hpp"

namespace ashlar {

/// Consecutive unknowns below that are consecutive elsewhere.
struct RowRun {
  int from;  ///< in the blocks below of this front
  int to;    ///< in the front of the parent, or in the vector of all unknowns
  int length;
};

/// Pivot columns of a front that are eliminated together, from their diagonal down, by columns.
struct FrontPanel {
  int start;           ///< first column
  int width;           ///< columns
  int rows;            ///< unknowns of the front from `start` on
  std::size_t values;  ///< place of the first value in the factor
};

/// A block of the matrix in the front that eliminates it.
struct FrontBlock {
  int row, column;    ///< of the front, of the block's first entry
  int matrix_column;  ///< first column of the block in the matrix
  int place;  ///< of the block's first row in the column's rows; 0: on the diagonal, from the diagonal down
  int height, width;  ///< of the block in the matrix
  bool transposed;    ///< its columns are rows of the front
};

struct Front {
  int first_block, last_block;          ///< pivots, by place in the order
  std::vector<int> blocks_below;        ///< by place in the order, increasing
  int parent = -1;                      ///< -1: none, a root
  std::vector<int> children = {};       ///< increasing
  int start = 0;                        ///< place of the first pivot in the vector of all unknowns
  int pivots = 0, below = 0;            ///< unknowns
  std::vector<FrontPanel> panels = {};  ///< of the pivots
  std::vector<FrontBlock> blocks = {};  ///< of the matrix
  std::vector<RowRun> in_parent = {};   ///< the unknowns below in the parent's front
  std::vector<RowRun> in_vector = {};   ///< the unknowns below in the vector of all unknowns
  double work = 0.0;                    ///< multiplications of its elimination
  double subtree_work = 0.0;            ///< with that of all its descendants
  bool kept = false;                    ///< its update outlasts the task that makes it
  int stack = 0;                        ///< 0 or 1: where the update lies unless it is kept
  std::size_t update = 0;               ///< place of the update there, or among those kept
  std::size_t vector = 0;               ///< place of its vector, (size), among those of all fronts

  [[nodiscard]] int size() const { return pivots + below; }
};

/// Consecutive fronts that one task eliminates: whole subtrees, or a front near a root.
struct TreePart {
  int first, last;
  bool shared = false;  ///< one wide front, to be shared by several tasks
};

struct FrontTree {
  std::vector<int> order;     ///< block at each place
  std::vector<int> start;     ///< (#blocks + 1) first unknown of the block at each place
  std::vector<Front> fronts;  ///< each after its descendants
  std::vector<TreePart> parts;
  double work = 0.0;                     ///< multiplications of a factor
  std::size_t entries = 0;               ///< of the factor's lower triangle
  std::size_t panel_values = 0;          ///< stored values of all panels
  std::size_t kept_values = 0;           ///< of all kept updates
  std::size_t stack_values[2] = {0, 0};  ///< most on each stack of a task
  std::size_t vector_values = 0;
  int largest_front = 0;  ///< unknowns

  [[nodiscard]] int size() const { return start.back(); }
};

/// @param matrix of dense blocks of these sizes, >= 0
/// @throws std::invalid_argument unless it is. @throws std::bad_alloc
[[nodiscard]] FrontTree make_front_tree(const SymmetricMatrix& matrix, const std::vector<int>& sizes);

}  // namespace ashlar

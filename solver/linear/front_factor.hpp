// Multifrontal Cholesky factor over a tree of fronts, in single or double precision, on several threads. Results have the
// same bits for any number of threads: the tasks and the order of all sums are those of the tree.
//
// A panel of a front holds 1/L in its triangle and L_below/L below it, so that a solution takes one matrix-vector product
// for each panel and direction:
//   forward   y = 1/L b,  b_below -= L_below/L b
//   backward  x = (1/L)' y - (L_below/L)' x_below
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <vector>

#include "solver/linear/aligned_values.hpp"
#include "solver/linear/front_tasks.hpp"
#include "solver/linear/front_tree.hpp"

namespace ashlar {

/// @tparam T float or double
template <class T>
class FrontFactor {
 public:
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  /// @param tree must outlive the factor
  explicit FrontFactor(const FrontTree& tree);

  /// @param matrix of the tree's pattern. @param threads >= 1
  /// @return false: not positive definite, in this precision
  [[nodiscard]] bool factorize(const SymmetricMatrix& matrix, int threads);
  /// Solves with the last matrix that was factorised successfully.
  /// @param x right side, then solution, in the tree's order of unknowns
  void solve(Vector& x, int threads);

 private:
  /// Memory of a worker: updates of its fronts, and a vector of a front.
  struct Room {
    AlignedValues<T> stacks[2];
    AlignedValues<T> product;
  };
  /// Values of a tile from its diagonal down.
  struct TileValues {
    FrontTile columns;
    T* first;
    int distance;  ///< of the columns

    /// Values by rows of the front.
    [[nodiscard]] T* column(int c) const {
      return first + std::ptrdiff_t{c - columns.start} * distance - columns.start;
    }
  };

  void prepare_rooms(int threads);
  [[nodiscard]] T* panel_of(const FrontPanel& panel) const { return panels_.data() + panel.values; }
  [[nodiscard]] T* update_of(const Front& front, const Room& room) const;
  [[nodiscard]] TileValues values_of(const Front& front, int tile, bool shared, const Room& room) const;

  void run(const FactorTask& task, const SymmetricMatrix& matrix, const Room& room);
  void eliminate_front(const Front& front, const SymmetricMatrix& matrix, const Room& room);
  void assemble(const Front& front, const TileValues& tile, const SymmetricMatrix& matrix,
                const Room& room) const;
  void add_child(const Front& child, const TileValues& tile, const Room& room) const;
  void eliminate(const FrontPanel& panel);
  void update(const Front& front, const FrontPanel& panel, const TileValues& tile, bool shared) const;
  void finish(const FrontPanel& panel) const;

  void run(const SolutionTask& task, Vector& x, const Room& room);
  void start_forward(const Front& front, Vector& x) const;
  void forward_rows(const Front& front, const FrontPanel& panel, int first, int end, Vector& x,
                    const Room& room);
  void start_backward(const Front& front, const Vector& x) const;
  void backward_columns(const Front& front, const FrontPanel& panel, int first, int end, Vector& x) const;

  const FrontTree& tree_;
  FactorTasks factor_tasks_;
  SolutionTasks solution_tasks_;
  AlignedValues<T> panels_, kept_;
  AlignedValues<T>
      vectors_;    ///< of each front: upward its update of the right side, downward unknowns, with signs
  Vector middle_;  ///< y, between both directions
  std::vector<Room> rooms_;
  std::atomic<bool> failed_ = false;
};

extern template class FrontFactor<float>;
extern template class FrontFactor<double>;

}  // namespace ashlar

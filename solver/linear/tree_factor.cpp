#include "solver/linear/tree_factor.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/linear/front_factor.hpp"

namespace ashlar {
namespace {

/// Largest residual of a row relative to the largest right side, both in units of the root of the row's diagonal: the same
/// for any units of the unknowns.
double relative_residual(const SymmetricMatrix& matrix, const Eigen::VectorXd& residual,
                         const Eigen::VectorXd& right_side) {
  double most = 0.0, of_right_side = 0.0;
  for (int k = 0; k < matrix.size; ++k) {
    const double unit = std::sqrt(matrix.values[at(matrix.column_start[at(k)])]);
    most = std::max(most, std::abs(residual[k]) / unit);
    of_right_side = std::max(of_right_side, std::abs(right_side[k]) / unit);
  }
  return most / of_right_side;
}

/// A right side with all unknowns in play, each in units of the root of its diagonal: +1 and -1 without order.
Eigen::VectorXd probe_of(const SymmetricMatrix& matrix) {
  Eigen::VectorXd probe(matrix.size);
  unsigned state = 1;
  for (int k = 0; k < matrix.size; ++k) {
    state = 1664525U * state + 1013904223U;  // Numerical Recipes' quick generator
    const double size = std::sqrt(matrix.values[at(matrix.column_start[at(k)])]);
    probe[k] = (state >> 31U) != 0 ? size : -size;
  }
  return probe;
}

}  // namespace

struct TreeFactor::Implementation {
  std::vector<int> sizes;
  std::vector<int> first;
  FactorUse use;
  SymmetricMatrix matrix;
  std::optional<FrontTree> tree;
  std::optional<FrontFactor<float>> in_single;
  std::optional<FrontFactor<double>> in_double;
  bool factored = false;
  FactorPrecision wanted = FactorPrecision::in_double;     ///< of the last factor
  FactorPrecision precision = FactorPrecision::in_double;  ///< that it has
  int refinements = 1;                                     ///< of a refined solution
  FactorCounts counts;

  template <class T>
  [[nodiscard]] Eigen::VectorXd solve_with(FrontFactor<T>& factor, const Eigen::VectorXd& right_side) const {
    // Single precision has numbers from 1e-38 to 3e38 only.
    int exponent = 0;
    const double largest = right_side.lpNorm<Eigen::Infinity>();
    if (largest > 0.0 && std::isfinite(largest)) std::frexp(largest, &exponent);
    const double unit = std::ldexp(1.0, exponent);
    typename FrontFactor<T>::Vector x(right_side.size());
    each_block([&](Eigen::Index place, Eigen::Index row, Eigen::Index size) {
      x.segment(place, size) = (right_side.segment(row, size) / unit).template cast<T>();
    });
    factor.solve(x, use.threads);
    Eigen::VectorXd solution(right_side.size());
    each_block([&](Eigen::Index place, Eigen::Index row, Eigen::Index size) {
      solution.segment(row, size) = x.segment(place, size).template cast<double>() * unit;
    });
    return solution;
  }
  /// @param visit (place in the tree's order, first unknown, number) of each block
  template <class Visit>
  void each_block(const Visit& visit) const {
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      const int block = tree->order[k];
      visit(tree->start[k], first[at(block)], sizes[at(block)]);
    }
  }
  [[nodiscard]] Eigen::VectorXd solve_once(const Eigen::VectorXd& right_side) {
    return precision == FactorPrecision::in_single ? solve_with(*in_single, right_side)
                                                   : solve_with(*in_double, right_side);
  }

  [[nodiscard]] bool factorize_in_single() {
    if (!in_single) in_single.emplace(*tree);
    if (!in_single->factorize(matrix, use.threads)) return false;
    precision = FactorPrecision::in_single;
    const Eigen::VectorXd probe = probe_of(matrix);
    const double residual = relative_residual(matrix, probe - times(matrix, solve_once(probe)), probe);
    if (!(residual <= single_residual)) return false;
    refinements = 1;
    for (double left = residual * residual; left > refined_residual; left *= residual) ++refinements;
    return true;
  }
  [[nodiscard]] bool factorize_in_double() {
    if (!in_double) in_double.emplace(*tree);
    precision = FactorPrecision::in_double;
    refinements = 1;
    return in_double->factorize(matrix, use.threads);
  }
};

TreeFactor::TreeFactor(std::vector<int> sizes, const FactorUse& use)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->first = first_unknowns(sizes);
  implementation_->sizes = std::move(sizes);
  implementation_->use = use;
}
TreeFactor::~TreeFactor() = default;

void TreeFactor::set_use(const FactorUse& use) {
  implementation_->use = use;
}

FactorStatus TreeFactor::factorize(const SymmetricMatrix& matrix) {
  Implementation& self = *implementation_;
  const bool same_pattern = self.tree && matrix.size == self.matrix.size &&
                            matrix.column_start == self.matrix.column_start &&
                            matrix.rows == self.matrix.rows;
  const bool same_use = self.wanted == self.use.precision;
  if (same_pattern && self.factored && same_use && matrix.values == self.matrix.values) {
    ++self.counts.factorizations_reused;
    return FactorStatus::success;
  }
  self.factored = false;
  self.wanted = self.use.precision;
  self.matrix = matrix;
  if (!same_pattern) {
    self.in_single.reset();
    self.in_double.reset();
    self.tree = make_front_tree(matrix, self.sizes);
    ++self.counts.analyses;
  }
  ++self.counts.factorizations;
  const bool positive = std::all_of(matrix.column_start.begin(), matrix.column_start.end() - 1,
                                    [&](int diagonal) { return matrix.values[at(diagonal)] > 0.0; });
  if (!positive) return FactorStatus::not_positive_definite;
  if (self.wanted == FactorPrecision::in_single && self.factorize_in_single()) {
    self.in_double.reset();
    self.factored = true;
  } else {
    self.factored = self.factorize_in_double();
  }
  return self.factored ? FactorStatus::success : FactorStatus::not_positive_definite;
}

Eigen::VectorXd TreeFactor::solve(const Eigen::VectorXd& right_side, bool refined) {
  Implementation& self = *implementation_;
  if (!self.factored) throw std::logic_error("solve before a successful factorize");
  if (right_side.size() == 0) return right_side;
  ++self.counts.solves;
  Eigen::VectorXd solution = self.solve_once(right_side);
  if (!refined) return solution;
  for (int k = 0; k < self.refinements; ++k)
    solution += self.solve_once(right_side - times(self.matrix, solution));
  return solution;
}

FactorPrecision TreeFactor::precision() const {
  return implementation_->precision;
}

void set_use(LinearSolver& solver, const FactorUse& use) {
  if (auto* factor = dynamic_cast<TreeFactor*>(&solver)) factor->set_use(use);
}

const FactorCounts& TreeFactor::counts() const {
  return implementation_->counts;
}

double TreeFactor::cost_in_solves() const {
  const std::optional<FrontTree>& tree = implementation_->tree;
  // A solution takes two multiplications and two additions for each entry, a factor one of each for `work`.
  return tree && tree->entries > 0 ? tree->work / (4.0 * static_cast<double>(tree->entries)) : 0.0;
}

void TreeFactor::drop_counts() {
  implementation_->counts = {};
}

const SymmetricMatrix& TreeFactor::matrix() const {
  return implementation_->matrix;
}

}  // namespace ashlar

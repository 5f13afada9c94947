// Linear systems given by a matrix-vector product (Saad and Schultz 1986), for matrices near the identity: a handful
// of iterations, no restart.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace ashlar {

/// Inner products of the columns of a matrix (size, n) with a vector (size). @return (n)
using InnerProducts =
    std::function<Eigen::VectorXd(const Eigen::Ref<const Eigen::MatrixXd>&, const Eigen::VectorXd&)>;

/// When GMRES ends without a solution.
enum class KrylovEnd {
  after_all,  ///< after all allowed iterations
  if_slow,  ///< also from the third on, where the mean rate of the residuals would not reach the tolerance in all allowed
};

/// Outcome of a GMRES iteration.
struct KrylovSolution {
  Eigen::VectorXd x;
  bool converged = false;  ///< false: x is the best of those that were made
  int iterations = 0;
};

/// Minimises |b - A x| over growing Krylov spaces from x = 0.
/// @param times A x; @param tolerance of |b - A x| / |b|; @param most iterations, each one product
/// @param products of vectors of which several ranks have a part each; empty: of whole vectors. One call to begin with
/// and two in each iteration: vectors are made orthogonal by Gram and Schmidt's method twice, which is as accurate as one
/// vector after the other, and takes all products of a pass at once
[[nodiscard]] KrylovSolution gmres(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& times,
                                   const Eigen::VectorXd& right_side, double tolerance, int most,
                                   KrylovEnd end = KrylovEnd::after_all, const InnerProducts& products = {});

}  // namespace ashlar

// Linear systems given by a matrix-vector product (Saad and Schultz 1986), for matrices near the identity: a handful
// of iterations, no restart.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace ashlar {

using InnerProduct = std::function<double(const Eigen::VectorXd&, const Eigen::VectorXd&)>;

/// Outcome of a GMRES iteration.
struct KrylovSolution {
  Eigen::VectorXd x;
  bool converged = false;  ///< false: x is the best after all allowed iterations
  int iterations = 0;
};

/// Minimises |b - A x| over growing Krylov spaces from x = 0.
/// @param times A x; @param tolerance of |b - A x| / |b|; @param most iterations, each one product
/// @param dot inner product of vectors of which several ranks have a part each; empty: that of whole vectors
[[nodiscard]] KrylovSolution gmres(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& times,
                                   const Eigen::VectorXd& right_side, double tolerance, int most,
                                   const InnerProduct& dot = {});

}  // namespace ashlar

#include "solver/linear/gmres.hpp"

#include <Eigen/Jacobi>
#include <Eigen/LU>
#include <cmath>
#include <vector>

namespace ashlar {

KrylovSolution gmres(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& times,
                     const Eigen::VectorXd& right_side, double tolerance, int most, const InnerProduct& dot) {
  const auto length_of = [&dot](const Eigen::VectorXd& x) { return dot ? std::sqrt(dot(x, x)) : x.norm(); };
  KrylovSolution solution{Eigen::VectorXd::Zero(right_side.size()), false, 0};
  const double size = length_of(right_side);
  if (!(size > 0.0)) {
    solution.converged = size == 0.0;
    return solution;
  }
  Eigen::MatrixXd space(right_side.size(), most + 1);
  Eigen::MatrixXd upper = Eigen::MatrixXd::Zero(most + 1, most);
  Eigen::VectorXd reduced = Eigen::VectorXd::Zero(most + 1);
  std::vector<Eigen::JacobiRotation<double>> rotations;
  space.col(0) = right_side / size;
  reduced[0] = size;
  int used = 0;
  while (used < most && !solution.converged) {
    Eigen::VectorXd next = times(space.col(used));
    const double before = length_of(next);
    for (int k = 0; k <= used; ++k) {
      upper(k, used) = dot ? dot(space.col(k), next) : space.col(k).dot(next);
      next -= upper(k, used) * space.col(k);
    }
    const double length = length_of(next);
    upper(used + 1, used) = length;
    for (int k = 0; k < used; ++k)
      upper.col(used).applyOnTheLeft(k, k + 1, rotations[static_cast<std::size_t>(k)].adjoint());
    Eigen::JacobiRotation<double> rotation;
    rotation.makeGivens(upper(used, used), upper(used + 1, used));
    upper.col(used).applyOnTheLeft(used, used + 1, rotation.adjoint());
    reduced.applyOnTheLeft(used, used + 1, rotation.adjoint());
    rotations.push_back(rotation);
    ++used;
    solution.converged = std::abs(reduced[used]) <= tolerance * size;
    // The Krylov space is exhausted: it contains the solution.
    if (!(length > 1e-14 * before)) break;
    space.col(used) = next / length;
  }
  solution.iterations = used;
  const auto triangle = upper.topLeftCorner(used, used).triangularView<Eigen::Upper>();
  solution.x = space.leftCols(used) * triangle.solve(reduced.head(used));
  solution.converged = solution.converged && solution.x.allFinite();
  return solution;
}

}  // namespace ashlar

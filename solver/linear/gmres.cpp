#include "solver/linear/gmres.hpp"

#include <Eigen/Jacobi>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {

namespace {

/// True if residuals that fall on at their mean rate do not reach the tolerance in all allowed iterations.
/// @param residual over the right side, after the iterations used
bool is_slow(double residual, int used, double tolerance, int most) {
  constexpr int first = 3;  // residuals of the first two do not show a rate yet
  return used >= first && residual > 0.0 &&
         correctly_rounded::log(residual) * most > correctly_rounded::log(tolerance) * used;
}

}  // namespace

KrylovSolution gmres(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& times,
                     const Eigen::VectorXd& right_side, double tolerance, int most, KrylovEnd end,
                     const InnerProducts& products) {
  const auto products_of = [&products](const Eigen::Ref<const Eigen::MatrixXd>& columns,
                                       const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return products ? products(columns, x) : Eigen::VectorXd(columns.transpose() * x);
  };
  KrylovSolution solution{Eigen::VectorXd::Zero(right_side.size()), false, 0};
  const double size = std::sqrt(products_of(right_side, right_side)[0]);
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
    const auto before = space.leftCols(used + 1);
    const Eigen::VectorXd along = products_of(before, next);
    next -= before * along;
    space.col(used + 1) = next;
    const Eigen::VectorXd rest = products_of(space.leftCols(used + 2), next);
    next -= before * rest.head(used + 1);
    // `rest` is of the size of rounding, apart from the last: the difference is accurate.
    const double length = std::sqrt(std::max(0.0, rest[used + 1] - rest.head(used + 1).squaredNorm()));
    upper.col(used).head(used + 1) = along + rest.head(used + 1);
    upper(used + 1, used) = length;
    const double whole = correctly_rounded::hypot(along.norm(), length);
    for (int k = 0; k < used; ++k)
      upper.col(used).applyOnTheLeft(k, k + 1, rotations[static_cast<std::size_t>(k)].adjoint());
    Eigen::JacobiRotation<double> rotation;
    rotation.makeGivens(upper(used, used), upper(used + 1, used));
    upper.col(used).applyOnTheLeft(used, used + 1, rotation.adjoint());
    reduced.applyOnTheLeft(used, used + 1, rotation.adjoint());
    rotations.push_back(rotation);
    ++used;
    solution.converged = std::abs(reduced[used]) <= tolerance * size;
    if (end == KrylovEnd::if_slow && !solution.converged &&
        is_slow(std::abs(reduced[used]) / size, used, tolerance, most))
      break;
    // The Krylov space is exhausted: it contains the solution.
    if (!(length > 1e-14 * whole)) break;
    space.col(used) = next / length;
  }
  solution.iterations = used;
  const auto triangle = upper.topLeftCorner(used, used).triangularView<Eigen::Upper>();
  solution.x = space.leftCols(used) * triangle.solve(reduced.head(used));
  solution.converged = solution.converged && solution.x.allFinite();
  return solution;
}

}  // namespace ashlar

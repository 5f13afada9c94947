// Compares analytic derivatives with finite differences of the function; the only helper for this purpose.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <functional>

namespace ashlar::test_support {

/// Central differences of a vector function. @return (#outputs, #inputs)
inline Eigen::MatrixXd difference_matrix(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function, const Eigen::VectorXd& place,
    double step) {
  Eigen::MatrixXd result(function(place).size(), place.size());
  for (Eigen::Index k = 0; k < place.size(); ++k) {
    Eigen::VectorXd plus = place;
    Eigen::VectorXd minus = place;
    plus[k] += step;
    minus[k] -= step;
    result.col(k) = (function(plus) - function(minus)) / (2.0 * step);
  }
  return result;
}

/// Expects `analytic` to be the derivative of `function` at `place`, relative to its own size.
inline void expect_derivative(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function,
                              const Eigen::VectorXd& place, const Eigen::MatrixXd& analytic, double step,
                              double tolerance) {
  const Eigen::MatrixXd difference = difference_matrix(function, place, step);
  EXPECT_LE((difference - analytic).norm(), tolerance * (analytic.norm() + difference.norm()));
}

}  // namespace ashlar::test_support

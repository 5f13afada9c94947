// Algebra of the cone x0 >= |x1, x2| and the Nesterov-Todd scaling, for the iteration of a cone programme.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ashlar::cone {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Largest length of a step, relative to the step: one that stays in the cone at any length has this one.
inline constexpr double longest_step = 1e30;

inline double determinant(const Vector3d& x) {
  const double t = x.tail<2>().norm();
  return (x[0] - t) * (x[0] + t);
}

inline Vector3d product(const Vector3d& x, const Vector3d& y) {
  Vector3d r;
  r[0] = x.dot(y);
  r.tail<2>() = x[0] * y.tail<2>() + y[0] * x.tail<2>();
  return r;
}

/// Solution r of product(x, r) = y.
inline Vector3d quotient(const Vector3d& x, const Vector3d& y) {
  Vector3d r;
  r[0] = (x[0] * y[0] - x.tail<2>().dot(y.tail<2>())) / determinant(x);
  r.tail<2>() = (y.tail<2>() - r[0] * x.tail<2>()) / x[0];
  return r;
}

/// Largest a <= longest_step for which x + a d is in the cone, with x in its interior.
inline double longest_way(const Vector3d& x, const Vector3d& d) {
  const double a = d[0] * d[0] - d.tail<2>().squaredNorm();
  const double b = x[0] * d[0] - x.tail<2>().dot(d.tail<2>());
  const double c = std::max(determinant(x), 0.0);
  double length = d[0] < 0.0 ? -x[0] / d[0] : longest_step;
  const double root = b * b - a * c;
  if (root < 0.0) return length;
  const double q = -(b + (b >= 0.0 ? std::sqrt(root) : -std::sqrt(root)));
  for (const double t : {a != 0.0 ? q / a : longest_step, q != 0.0 ? c / q : longest_step})
    if (t > 0.0) length = std::min(length, t);
  return length;
}

inline double longest_way(double x, double d) {
  return d < 0.0 ? -x / d : longest_step;
}

/// W with W z = W^-1 x.
struct Scaling {
  Matrix3d forth = Matrix3d::Identity();  ///< W
  Matrix3d back = Matrix3d::Identity();   ///< W^-1
};

inline Scaling scaling_of(const Vector3d& x, const Vector3d& z) {
  constexpr double tiny = std::numeric_limits<double>::min();
  const double size_x = std::sqrt(std::max(determinant(x), tiny));
  const double size_z = std::sqrt(std::max(determinant(z), tiny));
  const Vector3d x1 = x / size_x;
  Vector3d z1 = z / size_z;
  const double half = std::sqrt(0.5 * (1.0 + x1.dot(z1)));
  z1.tail<2>() *= -1.0;
  const Vector3d w = (x1 + z1) / (2.0 * half);
  const double eta = std::sqrt(size_x / size_z);
  const auto matrix = [&](double sign) {
    Matrix3d m;
    m(0, 0) = w[0];
    m.block<1, 2>(0, 1) = sign * w.tail<2>().transpose();
    m.block<2, 1>(1, 0) = sign * w.tail<2>();
    m.bottomRightCorner<2, 2>() =
        Eigen::Matrix2d::Identity() + w.tail<2>() * w.tail<2>().transpose() / (1.0 + w[0]);
    return m;
  };
  return {eta * matrix(1.0), matrix(-1.0) / eta};
}

}  // namespace ashlar::cone

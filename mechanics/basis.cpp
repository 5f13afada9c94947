#include "mechanics/basis.hpp"

#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <stdexcept>

#include "mechanics/simplex_moments.hpp"

namespace ashlar {
namespace {

using Real = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Monomial coefficients of the Legendre polynomials L_0 to L_last. @return [k][power]
std::vector<std::vector<Real>> legendre_coefficients(int last) {
  std::vector<std::vector<Real>> table(at(last) + 1, std::vector<Real>(at(last) + 1, Real(0)));
  table[0][0] = 1;
  if (last >= 1) table[1][1] = 1;
  for (int k = 1; k < last; ++k) {
    for (int power = 0; power <= k + 1; ++power) {
      Real value = 0;
      if (power > 0) value += Real(2 * k + 1) * table[at(k)][at(power - 1)];
      value -= Real(k) * table[at(k - 1)][at(power)];
      table[at(k + 1)][at(power)] = value / Real(k + 1);
    }
  }
  return table;
}

/// Coefficients of L_i L_j = sum_k product[k] L_k for i, j <= order, from k L_(k) recurrences: multiplying by
/// x maps L_k to ((k+1) L_(k+1) + k L_(k-1)) / (2k+1), and L_(i+1) = ((2i+1) x L_i - i L_(i-1)) / (i+1).
std::vector<std::vector<std::vector<Real>>> legendre_products(int order) {
  const int last = 2 * order;
  std::vector<std::vector<std::vector<Real>>> table(
      at(order) + 1, std::vector<std::vector<Real>>(at(order) + 1, std::vector<Real>(at(last) + 2, Real(0))));
  for (int j = 0; j <= order; ++j) {
    table[0][at(j)][at(j)] = 1;
    for (int i = 0; i < order; ++i) {
      for (int k = 0; k <= last; ++k) {
        const Real& value = table[at(i)][at(j)][at(k)];
        if (value != 0) {
          const Real scaled = value * Real(2 * i + 1) / (Real(i + 1) * Real(2 * k + 1));
          table[at(i + 1)][at(j)][at(k + 1)] += scaled * Real(k + 1);
          if (k > 0) table[at(i + 1)][at(j)][at(k - 1)] += scaled * Real(k);
        }
        if (i > 0) table[at(i + 1)][at(j)][at(k)] -= table[at(i - 1)][at(j)][at(k)] * Real(i) / Real(i + 1);
      }
    }
  }
  return table;
}

/// Integrals over the block of L_a(xi) L_b(eta) L_c(zeta) dV / (half sizes' product), a + b + c <= degree.
std::vector<Real> legendre_moments(const std::vector<Real>& monomial_moments, int degree) {
  const auto coefficient = legendre_coefficients(degree);
  std::vector<Real> result;
  for (const auto& [a, b, c] : monomial_exponents(degree)) {
    Real sum = 0;
    for (int i = a % 2; i <= a; i += 2) {
      for (int j = b % 2; j <= b; j += 2) {
        const Real outer = coefficient[at(a)][at(i)] * coefficient[at(b)][at(j)];
        for (int k = c % 2; k <= c; k += 2) {
          sum += outer * coefficient[at(c)][at(k)] * monomial_moments[at(monomial_index(i, j, k))];
        }
      }
    }
    result.push_back(sum);
  }
  return result;
}

/// Lower triangle of the Gram matrix of the seeds. @return (p, p)
RealMatrix gram_matrix(const std::vector<Real>& legendre_moment, int order) {
  const auto product = legendre_products(order);
  const auto exponents = monomial_exponents(order);
  const int p = polynomial_count(order);
  RealMatrix gram = RealMatrix::Zero(p, p);
  for (int row = 0; row < p; ++row) {
    const auto& r = exponents[at(row)];
    for (int column = 0; column <= row; ++column) {
      const auto& s = exponents[at(column)];
      Real sum = 0;
      for (int a = std::abs(r[0] - s[0]); a <= r[0] + s[0]; a += 2) {
        for (int b = std::abs(r[1] - s[1]); b <= r[1] + s[1]; b += 2) {
          const Real outer = product[at(r[0])][at(s[0])][at(a)] * product[at(r[1])][at(s[1])][at(b)];
          for (int c = std::abs(r[2] - s[2]); c <= r[2] + s[2]; c += 2) {
            sum += outer * product[at(r[2])][at(s[2])][at(c)] * legendre_moment[at(monomial_index(a, b, c))];
          }
        }
      }
      gram(row, column) = sum;
    }
  }
  return gram;
}

RealMatrix cholesky_factor(RealMatrix matrix) {
  const Eigen::Index p = matrix.rows();
  for (Eigen::Index j = 0; j < p; ++j) {
    for (Eigen::Index k = 0; k < j; ++k) {
      const Real factor = matrix(j, k);
      for (Eigen::Index i = j; i < p; ++i) matrix(i, j) -= matrix(i, k) * factor;
    }
    if (!(matrix(j, j) > 0)) throw std::domain_error("the block is too thin for a polynomial of this order");
    const Real root = sqrt(matrix(j, j));
    for (Eigen::Index i = j; i < p; ++i) matrix(i, j) /= root;
    for (Eigen::Index i = 0; i < j; ++i) matrix(i, j) = 0;
  }
  return matrix;
}

RealMatrix inverse_of_lower(const RealMatrix& lower) {
  const Eigen::Index p = lower.rows();
  RealMatrix inverse = RealMatrix::Zero(p, p);
  for (Eigen::Index j = 0; j < p; ++j) {
    inverse(j, j) = Real(1) / lower(j, j);
    for (Eigen::Index i = j + 1; i < p; ++i) {
      Real sum = 0;
      for (Eigen::Index k = j; k < i; ++k) sum += lower(i, k) * inverse(k, j);
      inverse(i, j) = -sum / lower(i, i);
    }
  }
  return inverse;
}

/// inverse(L) S L with S the derivative of the seeds along one axis: L_k' = sum of (2m+1) L_m, m = k-1, k-3,
/// ...
Eigen::MatrixXd derivative_matrix(const RealMatrix& lower, const RealMatrix& inverse, int order, int axis,
                                  double half_size) {
  const auto exponents = monomial_exponents(order);
  const Eigen::Index p = lower.rows();
  RealMatrix derived = RealMatrix::Zero(p, p);  // S L
  for (Eigen::Index row = 0; row < p; ++row) {
    auto e = exponents[static_cast<std::size_t>(row)];
    auto& k = e[at(axis)];
    for (k -= 1; k >= 0; k -= 2) {
      const Eigen::Index target = monomial_index(e[0], e[1], e[2]);
      const Real weight = Real(2 * k + 1) / Real(half_size);
      for (Eigen::Index column = 0; column <= target; ++column)
        derived(row, column) += weight * lower(target, column);
    }
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(p, p);
  for (Eigen::Index row = 0; row < p; ++row) {
    const auto& e = exponents[static_cast<std::size_t>(row)];
    const Eigen::Index columns = polynomial_count(e[0] + e[1] + e[2] - 1);
    for (Eigen::Index column = 0; column < columns; ++column) {
      Real sum = 0;
      for (Eigen::Index k = column; k <= row; ++k) {
        if (derived(k, column) != 0) sum += inverse(row, k) * derived(k, column);
      }
      result(row, column) = static_cast<double>(sum);
    }
  }
  return result;
}

}  // namespace

PolynomialBasis::PolynomialBasis(const Polyhedron& solid, int order) : order_(order) {
  if (order < 0 || order > max_order) throw std::invalid_argument("order of a basis must be 0 to 12");
  Vector3 low = solid.mesh().points.front();
  Vector3 high = low;
  for (const Vector3& point : solid.mesh().points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  center_ = 0.5 * (low + high);
  half_size_ = 0.5 * (high - low);

  std::vector<std::array<Real, 3>> points;
  for (const Vector3& point : solid.mesh().points) {
    std::array<Real, 3> scaled;
    for (int axis = 0; axis < 3; ++axis) {
      scaled[at(axis)] = (Real(point[axis]) - Real(center_[axis])) / Real(half_size_[axis]);
    }
    points.push_back(scaled);
  }
  const int degree = std::max(2 * order, 2);
  std::vector<Real> monomial_moments = moment_sums(points, solid.mesh().triangles, degree);
  const auto factorial = factorials<Real>(degree + 3);
  const Real jacobian = Real(half_size_[0]) * Real(half_size_[1]) * Real(half_size_[2]);
  for (const auto& [a, b, c] : monomial_exponents(degree)) {
    monomial_moments[at(monomial_index(a, b, c))] *=
        jacobian * factorial[at(a)] * factorial[at(b)] * factorial[at(c)] / factorial[at(a + b + c + 3)];
  }

  const Real volume = monomial_moments[0];
  volume_ = static_cast<double>(volume);
  std::array<Real, 3> mean;
  for (int axis = 0; axis < 3; ++axis) {
    mean[at(axis)] = monomial_moments[at(1 + axis)] / volume;
    centroid_[axis] = static_cast<double>(Real(center_[axis]) + mean[at(axis)] * Real(half_size_[axis]));
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      std::array<int, 3> e = {0, 0, 0};
      ++e[at(i)];
      ++e[at(j)];
      const Real centred =
          monomial_moments[at(monomial_index(e[0], e[1], e[2]))] - mean[at(i)] * mean[at(j)] * volume;
      second_moment_(i, j) = static_cast<double>(centred * Real(half_size_[i]) * Real(half_size_[j]));
    }
  }

  const RealMatrix lower = cholesky_factor(gram_matrix(legendre_moments(monomial_moments, degree), order));
  const RealMatrix inverse = inverse_of_lower(lower);
  from_seeds_ = inverse.unaryExpr([](const Real& x) { return static_cast<double>(x); });
  for (int axis = 0; axis < 3; ++axis) {
    derivatives_[at(axis)] = derivative_matrix(lower, inverse, order, axis, half_size_[axis]);
  }

  // seed = L phi: the coefficients of a seed function are a row of L; X = center + half_size seed(1, 2, 3).
  identity_map_ = Eigen::MatrixX3d::Zero(size(), 3);
  for (int axis = 0; axis < 3; ++axis) {
    if (order == 0) {
      identity_map_(0, axis) = centroid_[axis] * static_cast<double>(lower(0, 0));
      continue;
    }
    const Real scale(half_size_[axis]);
    identity_map_(0, axis) =
        static_cast<double>(Real(center_[axis]) * lower(0, 0) + scale * lower(1 + axis, 0));
    for (int k = 1; k <= 3; ++k) identity_map_(k, axis) = static_cast<double>(scale * lower(1 + axis, k));
  }
}

Eigen::VectorXd PolynomialBasis::seeds(const Vector3& point) const {
  Eigen::Matrix<double, max_order + 1, 3> legendre;
  const Vector3 local = (point - center_).cwiseQuotient(half_size_);
  legendre.row(0).setOnes();
  if (order_ >= 1) legendre.row(1) = local.transpose();
  for (int k = 1; k < order_; ++k) {
    legendre.row(k + 1) =
        ((2 * k + 1) * local.transpose().cwiseProduct(legendre.row(k)) - k * legendre.row(k - 1)) / (k + 1);
  }
  Eigen::VectorXd result(size());
  Eigen::Index place = 0;
  for (int degree = 0; degree <= order_; ++degree) {
    for (int a = degree; a >= 0; --a) {
      for (int b = degree - a; b >= 0; --b) {
        result[place++] = legendre(a, 0) * legendre(b, 1) * legendre(degree - a - b, 2);
      }
    }
  }
  return result;
}

Eigen::VectorXd PolynomialBasis::values(const Vector3& point) const {
  return from_seeds_.triangularView<Eigen::Lower>() * seeds(point);
}

Eigen::MatrixXd PolynomialBasis::values(const std::vector<Vector3>& points) const {
  Eigen::MatrixXd seed(size(), static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) seed.col(static_cast<Eigen::Index>(k)) = seeds(points[k]);
  return (from_seeds_.triangularView<Eigen::Lower>() * seed).transpose();
}

Eigen::MatrixX3d PolynomialBasis::gradients(const Vector3& point) const {
  const Eigen::VectorXd phi = values(point);
  Eigen::MatrixX3d result(size(), 3);
  for (int axis = 0; axis < 3; ++axis)
    result.col(axis) = derivative(axis).triangularView<Eigen::Lower>() * phi;
  return result;
}

Eigen::MatrixX3d PolynomialBasis::linear_field(const Vector3& value, const Eigen::Matrix3d& gradient) const {
  Eigen::MatrixX3d coefficients = identity_map_ * gradient.transpose();
  coefficients.row(0) += std::sqrt(volume_) * (value - gradient * centroid_).transpose();
  return coefficients;
}

}  // namespace ashlar

#include "mechanics/basis/legendre_seeds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "geometry/index.hpp"
#include "mechanics/basis/multi_index.hpp"
#include "mechanics/basis/simplex_moments.hpp"

namespace ashlar {
namespace {

/// Monomial coefficients of the Legendre polynomials L_0 to L_last. @return [k][power]
template <class Real>
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
template <class Real>
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

/// a! b! c!/(a+b+c+3)! of simplex_moments.hpp.
template <class Real>
void multiply_by_factorials(std::vector<Real>& sums, int degree) {
  const auto factorial = factorials<Real>(degree + 3);
  for (const auto& [a, b, c] : monomial_exponents(degree))
    sums[at(monomial_index(a, b, c))] *=
        factorial[at(a)] * factorial[at(b)] * factorial[at(c)] / factorial[at(a + b + c + 3)];
}

}  // namespace

template <class Real>
std::vector<Real> legendre_moments(const std::vector<Real>& monomial_moments, int degree) {
  const auto coefficient = legendre_coefficients<Real>(degree);
  std::vector<Real> result;
  for (const auto& [a, b, c] : monomial_exponents(degree)) {
    Real sum = 0;
    for (int i = a % 2; i <= a; i += 2) {
      for (int j = b % 2; j <= b; j += 2) {
        const Real outer = coefficient[at(a)][at(i)] * coefficient[at(b)][at(j)];
        for (int k = c % 2; k <= c; k += 2)
          sum += outer * coefficient[at(c)][at(k)] * monomial_moments[at(monomial_index(i, j, k))];
      }
    }
    result.push_back(sum);
  }
  return result;
}

double legendre_size(const std::vector<double>& moment_sizes, int degree) {
  auto coefficient = legendre_coefficients<double>(degree);
  for (auto& row : coefficient)
    for (double& value : row) value = std::abs(value);
  double largest = 0.0;
  for (const auto& [a, b, c] : monomial_exponents(degree)) {
    double sum = 0.0;
    for (int i = a % 2; i <= a; i += 2)
      for (int j = b % 2; j <= b; j += 2)
        for (int k = c % 2; k <= c; k += 2)
          sum += coefficient[at(a)][at(i)] * coefficient[at(b)][at(j)] * coefficient[at(c)][at(k)] *
                 moment_sizes[at(monomial_index(i, j, k))];
    largest = std::max(largest, sum);
  }
  return largest;
}

template <class Real>
RealMatrix<Real> gram_matrix(const std::vector<Real>& legendre_moments, int order) {
  const auto product = legendre_products<Real>(order);
  const auto exponents = monomial_exponents(order);
  const int p = polynomial_count(order);
  RealMatrix<Real> gram = RealMatrix<Real>::Zero(p, p);
  for (int row = 0; row < p; ++row) {
    const auto& r = exponents[at(row)];
    for (int column = 0; column <= row; ++column) {
      const auto& s = exponents[at(column)];
      Real sum = 0;
      for (int a = std::abs(r[0] - s[0]); a <= r[0] + s[0]; a += 2) {
        for (int b = std::abs(r[1] - s[1]); b <= r[1] + s[1]; b += 2) {
          const Real outer = product[at(r[0])][at(s[0])][at(a)] * product[at(r[1])][at(s[1])][at(b)];
          for (int c = std::abs(r[2] - s[2]); c <= r[2] + s[2]; c += 2) {
            sum += outer * product[at(r[2])][at(s[2])][at(c)] * legendre_moments[at(monomial_index(a, b, c))];
          }
        }
      }
      gram(row, column) = sum;
    }
  }
  return gram;
}

template <class Real>
RealMatrix<Real> cholesky_factor(RealMatrix<Real> matrix, Eigen::Index& failed) {
  failed = -1;
  const Eigen::Index p = matrix.rows();
  for (Eigen::Index j = 0; j < p; ++j) {
    for (Eigen::Index k = 0; k < j; ++k) {
      const Real factor = matrix(j, k);
      for (Eigen::Index i = j; i < p; ++i) matrix(i, j) -= matrix(i, k) * factor;
    }
    if (!(matrix(j, j) > 0)) {
      failed = j;
      break;
    }
    const Real root = sqrt(matrix(j, j));
    for (Eigen::Index i = j; i < p; ++i) matrix(i, j) /= root;
    for (Eigen::Index i = 0; i < j; ++i) matrix(i, j) = Real(0);
  }
  return matrix;
}

template <class Real>
RealMatrix<Real> inverse_of_lower(const RealMatrix<Real>& lower) {
  const Eigen::Index p = lower.rows();
  RealMatrix<Real> inverse = RealMatrix<Real>::Zero(p, p);
  for (Eigen::Index j = 0; j < p; ++j) {
    inverse(j, j) = Real(1);
    // By columns, in memory order.
    for (Eigen::Index k = j; k < p; ++k) {
      inverse(k, j) /= lower(k, k);
      const Real factor = inverse(k, j);
      for (Eigen::Index i = k + 1; i < p; ++i) inverse(i, j) -= lower(i, k) * factor;
    }
  }
  return inverse;
}

// S: L_k' = sum of (2m+1) L_m, m = k-1, k-3, ...
template <class Real>
Eigen::MatrixXd derivative_matrix(const RealMatrix<Real>& lower, const RealMatrix<Real>& inverse, int order,
                                  int axis) {
  const auto exponents = monomial_exponents(order);
  const Eigen::Index p = lower.rows();
  RealMatrix<Real> derived = RealMatrix<Real>::Zero(p, p);  // S L
  for (Eigen::Index row = 0; row < p; ++row) {
    auto e = exponents[static_cast<std::size_t>(row)];
    auto& k = e[at(axis)];
    for (k -= 1; k >= 0; k -= 2) {
      const Eigen::Index target = monomial_index(e[0], e[1], e[2]);
      const Real weight(2 * k + 1);
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
      result(row, column) = rounded(sum);
    }
  }
  return result;
}

template <class Real>
std::vector<Real> monomial_moments(const RealPoints<Real>& points, const TriangleMesh& mesh, int degree) {
  std::vector<Real> result = moment_sums(points, mesh.triangles, degree);
  multiply_by_factorials(result, degree);
  return result;
}

template <class Real>
std::vector<Real> multiplied(const RealMatrix<Real>& lower, const RealMatrix<Real>& inverse,
                             const std::vector<std::array<int, 3>>& exponents, const SeedProduct& product) {
  const auto& [axis, parent, first, k] = product;
  std::vector<Real> of_seeds(at(k) + 1, Real(0));
  for (int j = 0; j <= parent; ++j) {
    auto e = exponents[at(j)];
    const int degree = e[at(axis)];
    const Real weight = inverse(parent, j) / Real(2 * degree + 1);
    ++e[at(axis)];
    of_seeds[at(monomial_index(e[0], e[1], e[2]))] += weight * Real(degree + 1);
    if (degree == 0) continue;
    e[at(axis)] -= 2;
    of_seeds[at(monomial_index(e[0], e[1], e[2]))] += weight * Real(degree);
  }
  std::vector<Real> result;
  for (int m = first; m <= k; ++m) {
    Real sum = 0;
    for (int j = m; j <= k; ++j) sum += of_seeds[at(j)] * lower(j, m);
    result.push_back(sum);
  }
  return result;
}

template <class Real>
std::vector<Real> seed_values(const std::array<Real, 3>& xi, int order) {
  std::array<std::vector<Real>, 3> legendre;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto& values = legendre[axis];
    values = {Real(1), xi[axis]};
    for (int k = 1; k < order; ++k)
      values.push_back((Real(2 * k + 1) * xi[axis] * values[at(k)] - Real(k) * values[at(k - 1)]) /
                       Real(k + 1));
  }
  std::vector<Real> seeds;
  for (const auto& [a, b, c] : monomial_exponents(order))
    seeds.push_back(legendre[0][at(a)] * legendre[1][at(b)] * legendre[2][at(c)]);
  return seeds;
}

std::vector<double> moment_sizes(const std::vector<Vector3>& points, const TriangleMesh& mesh, int degree) {
  std::vector<double> sizes(at(polynomial_count(degree)), 0.0);
  std::vector<double> series;
  for (const auto& triangle : mesh.triangles) {
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis) corners[k][at(axis)] = std::abs(points[at(triangle[k])][axis]);
    const auto& [a, b, c] = corners;
    const double determinant = a[0] * (b[1] * c[2] + b[2] * c[1]) + a[1] * (b[2] * c[0] + b[0] * c[2]) +
                               a[2] * (b[0] * c[1] + b[1] * c[0]);
    corner_series(corners, degree, series);
    for (std::size_t k = 0; k < sizes.size(); ++k) sizes[k] += determinant * series[k];
  }
  multiply_by_factorials(sizes, degree);
  return sizes;
}

#define ASHLAR_INSTANTIATE(Real)                                                                          \
  template std::vector<Real> monomial_moments(const RealPoints<Real>&, const TriangleMesh&, int);         \
  template std::vector<Real> legendre_moments(const std::vector<Real>&, int);                             \
  template RealMatrix<Real> gram_matrix(const std::vector<Real>&, int);                                   \
  template RealMatrix<Real> cholesky_factor(RealMatrix<Real>, Eigen::Index&);                             \
  template RealMatrix<Real> inverse_of_lower(const RealMatrix<Real>&);                                    \
  template Eigen::MatrixXd derivative_matrix(const RealMatrix<Real>&, const RealMatrix<Real>&, int, int); \
  template std::vector<Real> multiplied(const RealMatrix<Real>&, const RealMatrix<Real>&,                 \
                                        const std::vector<std::array<int, 3>>&, const SeedProduct&);      \
  template std::vector<Real> seed_values(const std::array<Real, 3>&, int);
ASHLAR_INSTANTIATE(ExtendedDouble)
ASHLAR_INSTANTIATE(FiftyDigits)
#undef ASHLAR_INSTANTIATE

}  // namespace ashlar

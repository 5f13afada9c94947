#include "mechanics/basis/basis.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "geometry/index.hpp"
#include "mechanics/basis/quadrature.hpp"
#include "mechanics/basis/simplex_moments.hpp"

namespace ashlar {
namespace {

using Real = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

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

/// @param failed set to the first row that is no longer positive; -1: none
RealMatrix cholesky_factor(RealMatrix matrix, Eigen::Index& failed) {
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

/// inverse(L) S L with S the derivative of the seeds by one xi: L_k' = sum of (2m+1) L_m, m = k-1, k-3, ...
Eigen::MatrixXd derivative_matrix(const RealMatrix& lower, const RealMatrix& inverse, int order, int axis) {
  const auto exponents = monomial_exponents(order);
  const Eigen::Index p = lower.rows();
  RealMatrix derived = RealMatrix::Zero(p, p);  // S L
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
      result(row, column) = static_cast<double>(sum);
    }
  }
  return result;
}

using RealPoints = std::vector<std::array<Real, 3>>;

/// Integrals of the monomials of the given coordinates over the solid they bound, a + b + c <= degree.
std::vector<Real> monomial_moments(const RealPoints& points, const TriangleMesh& mesh, int degree) {
  std::vector<Real> result = moment_sums(points, mesh.triangles, degree);
  const auto factorial = factorials<Real>(degree + 3);
  for (const auto& [a, b, c] : monomial_exponents(degree)) {
    result[at(monomial_index(a, b, c))] *=
        factorial[at(a)] * factorial[at(b)] * factorial[at(c)] / factorial[at(a + b + c + 3)];
  }
  return result;
}

/// Principal axes, each nearest to the coordinate axis of its column; the coordinate axes if the second
/// moment is diagonal or has no direction.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& second_moment) {
  // Rounding must not turn the axes of a cube; any axes give a basis, so that nothing depends on this number.
  constexpr double negligible = 1e-9;
  const Eigen::Matrix3d diagonal = second_moment.diagonal().asDiagonal();
  if ((second_moment - diagonal).cwiseAbs().maxCoeff() <= negligible * second_moment.trace())
    return Eigen::Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(second_moment);
  Eigen::Matrix3d vectors = solver.eigenvectors();
  Eigen::Matrix3d axes;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Index nearest = 0;
    vectors.row(axis).cwiseAbs().maxCoeff(&nearest);
    axes.col(axis) = vectors.col(nearest) * (vectors(axis, nearest) < 0.0 ? -1.0 : 1.0);
    vectors.col(nearest).setZero();
  }
  return axes;
}

/// The weights of xi_axis phi_parent in the basis, from `first` to phi_k.
/// @return (k - first + 1)
std::vector<Real> multiplied(const RealMatrix& lower, const RealMatrix& inverse,
                             const std::vector<std::array<int, 3>>& exponents, int axis, int parent,
                             int first, int k) {
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

/// Legendre products at a point. @return (p)
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

}  // namespace

OrderTooHigh::OrderTooHigh(int order, int highest)
    : std::domain_error("order " + std::to_string(order) +
                        " is too high for this shape in double precision, " +
                        (highest > 0 ? "at most " + std::to_string(highest) + " is safe" : "as is any")),
      highest_safe_order(highest) {}

PolynomialBasis::PolynomialBasis(const Polyhedron& solid, int order)
    : PolynomialBasis(std::make_shared<const Parts>(solid, order), solid.mesh().points.front()) {}

PolynomialBasis::PolynomialBasis(std::shared_ptr<const Parts> parts, const Vector3& anchor)
    : parts_(std::move(parts)),
      anchor_(anchor),
      centroid_(anchor + parts_->centroid),
      identity_map_(parts_->identity_map) {
  // The first function is 1/sqrt(V), the others have no mean.
  identity_map_.row(0) += std::sqrt(parts_->volume) * anchor.transpose();
}

PolynomialBasis::Parts::Parts(const Polyhedron& solid, int the_order) : order(the_order) {
  if (order < 0 || order > max_order) throw std::invalid_argument("order of a basis must be 0 to 12");
  const TriangleMesh& mesh = solid.mesh();
  const Vector3& anchor = mesh.points.front();
  RealPoints points;
  for (const Vector3& point : mesh.points) {
    std::array<Real, 3> from_anchor;
    for (int axis = 0; axis < 3; ++axis) from_anchor[at(axis)] = Real(point[axis]) - Real(anchor[axis]);
    points.push_back(from_anchor);
  }
  const std::vector<Real> second = monomial_moments(points, mesh, 2);
  const Real& exact_volume = second[0];
  volume = static_cast<double>(exact_volume);
  std::array<Real, 3> mean;
  for (int axis = 0; axis < 3; ++axis) {
    mean[at(axis)] = second[at(1 + axis)] / exact_volume;
    centroid[axis] = static_cast<double>(mean[at(axis)]);
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      std::array<int, 3> e = {0, 0, 0};
      ++e[at(i)];
      ++e[at(j)];
      second_moment(i, j) = static_cast<double>(second[at(monomial_index(e[0], e[1], e[2]))] -
                                                mean[at(i)] * mean[at(j)] * exact_volume);
    }
  }

  axes = principal_axes(second_moment);
  Vector3 least = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 most = -least;
  for (const Vector3& point : mesh.points) {
    const Vector3 along = axes.transpose() * (point - anchor);
    least = least.cwiseMin(along);
    most = most.cwiseMax(along);
  }
  middle = 0.5 * (least + most);
  half_size = 0.5 * (most - least);
  RealMatrix exact_axes(3, 3);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) exact_axes(i, j) = Real(axes(i, j));
  }
  for (auto& point : points) {
    const std::array<Real, 3> from_anchor = point;
    for (int j = 0; j < 3; ++j) {
      Real along = -Real(middle[j]);
      for (int i = 0; i < 3; ++i) along += exact_axes(i, j) * from_anchor[at(i)];
      point[at(j)] = along / Real(half_size[j]);
    }
  }
  const int degree = std::max(2 * order, 2);
  std::vector<Real> scaled = monomial_moments(points, mesh, degree);
  // The axes are orthonormal but for rounding, so that the determinant of the map is not exactly that of h.
  const Real scale = exact_volume / scaled[0];
  for (Real& moment : scaled) moment *= scale;

  Eigen::Index failed = -1;
  const RealMatrix lower = cholesky_factor(gram_matrix(legendre_moments(scaled, degree), order), failed);
  if (failed >= 0) {
    const std::array<int, 3> e = monomial_exponents(order)[static_cast<std::size_t>(failed)];
    int highest = e[0] + e[1] + e[2] - 1;
    try {
      if (highest > 0) (void)Parts(solid, highest);
    } catch (const OrderTooHigh& error) {
      highest = error.highest_safe_order;
    }
    throw OrderTooHigh(order, highest);
  }
  const RealMatrix inverse = inverse_of_lower(lower);
  const auto exponents = monomial_exponents(order);
  constant = static_cast<double>(inverse(0, 0));
  for (int k = 1; k < polynomial_count(order); ++k) {
    auto e = exponents[at(k)];
    const auto axis = static_cast<int>(std::max_element(e.begin(), e.end()) - e.begin());
    const int first = std::max(0, polynomial_count(e[0] + e[1] + e[2] - 3));
    --e[at(axis)];
    const int parent = monomial_index(e[0], e[1], e[2]);
    const std::vector<Real> weights = multiplied(lower, inverse, exponents, axis, parent, first, k);
    Recurrence recurrence{axis, parent, first, Eigen::VectorXd(k - first),
                          static_cast<double>(weights.back())};
    for (int j = 0; j < k - first; ++j) recurrence.weights[j] = static_cast<double>(weights[at(j)]);
    recurrences.push_back(std::move(recurrence));
  }

  std::array<Eigen::MatrixXd, 3> local_derivatives;
  for (int j = 0; j < 3; ++j) {
    local_derivatives[at(j)] = derivative_matrix(lower, inverse, order, j) / half_size[j];
  }
  for (int i = 0; i < 3; ++i) {
    derivatives[at(i)] = axes(i, 0) * local_derivatives[0] + axes(i, 1) * local_derivatives[1] +
                         axes(i, 2) * local_derivatives[2];
  }

  // seed = L phi: the coefficients of a seed are a row of L. X - c = inverse(A') (m + h xi), xi = seeds 1
  // to 3.
  const RealMatrix back = exact_axes.transpose().inverse();
  identity_map = Eigen::MatrixX3d::Zero(polynomial_count(order), 3);
  for (int i = 0; i < 3; ++i) {
    if (order == 0) {
      identity_map(0, i) = centroid[i] * static_cast<double>(lower(0, 0));
      continue;
    }
    Real offset = 0;
    for (int j = 0; j < 3; ++j) offset += back(i, j) * Real(middle[j]);
    std::array<Real, 4> coefficients = {offset * lower(0, 0), Real(0), Real(0), Real(0)};
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k <= 1 + j; ++k)
        coefficients[at(k)] += back(i, j) * Real(half_size[j]) * lower(1 + j, k);
    }
    for (int k = 0; k < 4; ++k) identity_map(k, i) = static_cast<double>(coefficients[at(k)]);
  }

  int worst_degree = order + 1;
  // Points of the mesh are known exactly, in 50 digits and in double.
  constexpr std::size_t most_points = 16;
  const std::size_t stride = (points.size() + most_points - 1) / most_points;
  for (std::size_t n = 0; n < points.size(); n += stride) {
    const std::vector<Real> seeds = seed_values(points[n], order);
    const Vector3 xi = (axes.transpose() * (mesh.points[n] - anchor) - middle).cwiseQuotient(half_size);
    const Eigen::VectorXd rounded = values(xi);
    for (int k = 0; k < polynomial_count(order); ++k) {
      Real exact = 0;
      for (int j = 0; j <= k; ++j) exact += inverse(k, j) * seeds[at(j)];
      const double lost = std::abs(static_cast<double>(Real(rounded[k]) - exact)) * std::sqrt(volume);
      loss = std::max(loss, lost);
      const auto& e = exponents[at(k)];
      if (!(lost <= allowed_loss)) worst_degree = std::min(worst_degree, e[0] + e[1] + e[2]);
    }
  }
  if (worst_degree <= order) throw OrderTooHigh(order, worst_degree - 1);
}

Eigen::VectorXd PolynomialBasis::Parts::values(const Vector3& xi) const {
  Eigen::VectorXd phi(polynomial_count(order));
  phi[0] = constant;
  Eigen::Index k = 1;
  for (const auto& [axis, parent, first, weights, divisor] : recurrences) {
    phi[k] = (xi[axis] * phi[parent] - weights.dot(phi.segment(first, weights.size()))) / divisor;
    ++k;
  }
  return phi;
}

Eigen::VectorXd PolynomialBasis::values(const Vector3& point) const {
  return parts_->values(local(point));
}

Eigen::MatrixXd PolynomialBasis::values(const std::vector<Vector3>& points) const {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixX3d xi(count, 3);
  for (Eigen::Index n = 0; n < count; ++n) xi.row(n) = local(points[static_cast<std::size_t>(n)]);
  Eigen::MatrixXd phi(count, size());
  phi.col(0).setConstant(parts_->constant);
  Eigen::Index k = 1;
  for (const auto& [axis, parent, first, weights, divisor] : parts_->recurrences) {
    phi.col(k) = xi.col(axis).cwiseProduct(phi.col(parent));
    phi.col(k).noalias() -= phi.middleCols(first, weights.size()) * weights;
    phi.col(k) /= divisor;
    ++k;
  }
  return phi;
}

std::vector<Vector3> PolynomialBasis::sample_points() const {
  const SegmentRule rule = gauss_legendre(order() + 1);
  std::vector<Vector3> points;
  for (const double u : rule.points) {
    for (const double v : rule.points) {
      for (const double w : rule.points) {
        const Vector3 xi = 2.0 * Vector3(u, v, w) - Vector3::Ones();
        points.emplace_back(anchor_ + parts_->axes * (parts_->middle + parts_->half_size.cwiseProduct(xi)));
      }
    }
  }
  return points;
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
  coefficients.row(0) += std::sqrt(volume()) * (value - gradient * centroid_).transpose();
  return coefficients;
}

Eigen::MatrixXd PolynomialBasis::rigid_motions(double length) const {
  Eigen::MatrixXd motions(3 * size(), 6);
  for (int k = 0; k < 3; ++k) {
    const Vector3 axis = Vector3::Unit(k);
    Eigen::Matrix3d spin;
    for (int i = 0; i < 3; ++i) spin.col(i) = axis.cross(Vector3::Unit(i));
    motions.col(k) = linear_field(axis, Eigen::Matrix3d::Zero()).reshaped();
    motions.col(3 + k) = linear_field(Vector3::Zero(), spin / length).reshaped();
  }
  return motions;
}

}  // namespace ashlar

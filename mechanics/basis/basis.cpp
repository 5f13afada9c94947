#include "mechanics/basis/basis.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "geometry/index.hpp"
#include "mechanics/basis/legendre_seeds.hpp"
#include "mechanics/basis/quadrature.hpp"

namespace ashlar {
namespace {

/// Of the trace of the second moment: rounding must not rotate the axes of a cube. Any axes give a basis, so that results do
/// not depend on this value.
constexpr double negligible_product = 1e-9;

/// Principal axes, each in the column of the nearest coordinate axis; the coordinate axes if the second moment is
/// diagonal or isotropic.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& second_moment) {
  const Eigen::Matrix3d diagonal = second_moment.diagonal().asDiagonal();
  if ((second_moment - diagonal).cwiseAbs().maxCoeff() <= negligible_product * second_moment.trace())
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

/// Values to be rounded into Parts.
template <class Real>
struct PolynomialBasis::ExactParts {
  RealPoints<Real>
      points;  // from the first point, m; after scale() in the coordinates xi of the box along the axes
  Real volume;
  RealMatrix<Real> axes;     // (3, 3)
  RealMatrix<Real> lower;    // L, seed = L phi
  RealMatrix<Real> inverse;  // of L
  std::vector<std::array<int, 3>> exponents;
};

namespace {

/// Error of the integrals of products of functions: an eighth of the last place.
constexpr double allowed_error = 0x1p-56;
/// Relative error of volume and second moment: preserves the digits of small entries of a thin block's second moment.
constexpr double allowed_error_of_measure = 0x1p-80;
/// Errors of coordinates are relative to at least this, of half the box: smaller values overestimate those of coordinates
/// near zero, larger ones all. Each coordinate has some rounding errors.
constexpr double least_coordinate = 0x1p-10, operations_of_box = 8.0;
/// Rounding errors of a term of a moment: for each degree, and besides.
constexpr double operations_of_degree = 3.0, operations_of_moment = 12.0;
/// Points at which the loss of digits is measured, at most: more take longer and hardly find a larger one.
constexpr std::size_t most_points_of_loss = 16;

template <class Real>
constexpr bool is_last_resort = std::is_same_v<Real, FiftyDigits>;

/// Bounds the relative error of the terms of moments, see moment_sizes().
template <class Real>
double moment_error(int degree, double error_of_coordinates) {
  return (operations_of_degree * degree + operations_of_moment) *
         (unit_roundoff<Real> + error_of_coordinates);
}

}  // namespace

PolynomialBasis::Parts::Parts(const Polyhedron& solid, int the_order) : order(the_order) {
  if (order < 0 || order > max_order) throw std::invalid_argument("order of a basis must be 0 to 12");
  if (!make<ExtendedDouble, ExtendedDouble>(solid) && !make<FiftyDigits, ExtendedDouble>(solid))
    (void)make<FiftyDigits, FiftyDigits>(solid);
}

template <class MomentReal, class Real>
bool PolynomialBasis::Parts::make(const Polyhedron& solid) {
  const TriangleMesh& mesh = solid.mesh();
  ExactParts<MomentReal> of_moments;
  if (!measure(mesh, of_moments)) return false;
  choose_box(mesh);
  scale(of_moments);
  double error = 0.0;
  const std::vector<MomentReal> moments = seed_moments(mesh, of_moments, error);
  ExactParts<Real> exact;
  exact.exponents = monomial_exponents(order);
  exact.volume = converted<Real>(of_moments.volume);
  exact.axes = of_moments.axes.unaryExpr([](const MomentReal& value) { return converted<Real>(value); });
  for (const auto& [x, y, z] : of_moments.points)
    exact.points.push_back({converted<Real>(x), converted<Real>(y), converted<Real>(z)});
  std::vector<Real> rounded_moments;
  for (const MomentReal& moment : moments) rounded_moments.push_back(converted<Real>(moment));
  if (!orthonormalise(solid, rounded_moments, error, exact)) return false;
  make_recurrences(exact);
  make_derivatives(exact);
  make_identity_map(exact);
  measure_loss(mesh, exact);
  return true;
}

template <class Real>
bool PolynomialBasis::Parts::measure(const TriangleMesh& mesh, ExactParts<Real>& exact) {
  const Vector3& anchor = mesh.points.front();
  std::vector<Vector3> near;
  for (const Vector3& point : mesh.points) {
    std::array<Real, 3> from_anchor;
    for (int axis = 0; axis < 3; ++axis) from_anchor[at(axis)] = Real(point[axis]) - Real(anchor[axis]);
    exact.points.push_back(from_anchor);
    near.emplace_back(point - anchor);
  }
  const std::vector<Real> second = monomial_moments(exact.points, mesh, 2);
  exact.volume = second[0];
  volume = rounded(exact.volume);
  std::array<Real, 3> mean;
  for (int axis = 0; axis < 3; ++axis) {
    mean[at(axis)] = second[at(1 + axis)] / exact.volume;
    centroid[axis] = rounded(mean[at(axis)]);
  }
  double largest = 0.0;
  const std::vector<double> sizes = moment_sizes(near, mesh, 2);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      std::array<int, 3> e = {0, 0, 0};
      ++e[at(i)];
      ++e[at(j)];
      const int place = monomial_index(e[0], e[1], e[2]);
      second_moment(i, j) = rounded(Real(second[at(place)] - mean[at(i)] * mean[at(j)] * exact.volume));
      largest = std::max(largest, sizes[at(place)]);
    }
  }
  const double error = moment_error<Real>(2, unit_roundoff<Real>);
  return is_last_resort<Real> || (error * sizes[0] <= allowed_error_of_measure * volume &&
                                  error * largest <= allowed_error_of_measure * second_moment.trace());
}

void PolynomialBasis::Parts::choose_box(const TriangleMesh& mesh) {
  axes = principal_axes(second_moment);
  Vector3 least = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 most = -least;
  for (const Vector3& point : mesh.points) {
    const Vector3 along = axes.transpose() * (point - mesh.points.front());
    least = least.cwiseMin(along);
    most = most.cwiseMax(along);
  }
  middle = 0.5 * (least + most);
  half_size = 0.5 * (most - least);
}

template <class Real>
void PolynomialBasis::Parts::scale(ExactParts<Real>& exact) const {
  exact.axes.resize(3, 3);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) exact.axes(i, j) = Real(axes(i, j));
  }
  for (auto& point : exact.points) {
    const std::array<Real, 3> from_anchor = point;
    for (int j = 0; j < 3; ++j) {
      Real along = -Real(middle[j]);
      for (int i = 0; i < 3; ++i) along += exact.axes(i, j) * from_anchor[at(i)];
      point[at(j)] = along / Real(half_size[j]);
    }
  }
}

template <class Real>
std::vector<Real> PolynomialBasis::Parts::seed_moments(const TriangleMesh& mesh,
                                                       const ExactParts<Real>& exact, double& error) const {
  const int degree = std::max(2 * order, 2);
  std::vector<Real> monomial = monomial_moments(exact.points, mesh, degree);
  // The axes are orthonormal but for rounding, so that the determinant of the map is not exactly that of h.
  const Real scale = exact.volume / monomial[0];
  for (Real& moment : monomial) moment *= scale;
  // Relative rounding error of coordinates with cancellation.
  double cancelled = 0.0;
  std::vector<Vector3> xi;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const Vector3 terms = axes.cwiseAbs().transpose() * (mesh.points[n] - mesh.points.front()).cwiseAbs();
    cancelled = std::max(cancelled, (terms + middle.cwiseAbs()).cwiseQuotient(half_size).maxCoeff());
    const auto& [x, y, z] = exact.points[n];
    xi.push_back(Vector3(rounded(x), rounded(y), rounded(z)).cwiseAbs().cwiseMax(least_coordinate));
  }
  const double of_coordinates = operations_of_box * unit_roundoff<Real> * cancelled / least_coordinate;
  error = moment_error<Real>(degree, of_coordinates) * std::abs(rounded(scale)) *
          legendre_size(moment_sizes(xi, mesh, degree), degree);
  return legendre_moments(monomial, degree);
}

template <class Real>
bool PolynomialBasis::Parts::orthonormalise(const Polyhedron& solid, const std::vector<Real>& moments,
                                            double error, ExactParts<Real>& exact) const {
  const RealMatrix<Real> gram = gram_matrix(moments, order);
  const auto p = static_cast<double>(gram.rows());
  double trace = 0.0;
  for (Eigen::Index i = 0; i < gram.rows(); ++i) trace += rounded(gram(i, i));
  // G + E is factorised, so that the error of the integrals of phi phi' is inverse(L) E inverse(L)'. |E| is at most p
  // times the error of the moments plus the rounding of the factorisation. |inverse(L)|^2, of size trace(inverse(G)),
  // is at least p^2 / trace(G).
  const double off = p * (error + 4.0 * unit_roundoff<Real> * trace);
  if (!is_last_resort<Real> && !(off * p * p / trace <= allowed_error)) return false;
  Eigen::Index failed = -1;
  exact.lower = cholesky_factor(gram, failed);
  if (failed >= 0) {
    if (!is_last_resort<Real>) return false;
    const std::array<int, 3>& e = exact.exponents[static_cast<std::size_t>(failed)];
    int highest = e[0] + e[1] + e[2] - 1;
    try {
      if (highest > 0) (void)Parts(solid, highest);
    } catch (const OrderTooHigh& too_high) {
      highest = too_high.highest_safe_order;
    }
    throw OrderTooHigh(order, highest);
  }
  exact.inverse = inverse_of_lower(exact.lower);
  if (is_last_resort<Real>) return true;
  double inverse = 0.0;
  for (Eigen::Index i = 0; i < gram.rows(); ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      inverse += rounded(exact.inverse(i, j)) * rounded(exact.inverse(i, j));
  return off * inverse <= allowed_error;
}

template <class Real>
void PolynomialBasis::Parts::make_recurrences(const ExactParts<Real>& exact) {
  constant = rounded(exact.inverse(0, 0));
  for (int k = 1; k < polynomial_count(order); ++k) {
    auto e = exact.exponents[at(k)];
    const auto axis = static_cast<int>(std::max_element(e.begin(), e.end()) - e.begin());
    const int first = std::max(0, polynomial_count(e[0] + e[1] + e[2] - 3));
    --e[at(axis)];
    const int parent = monomial_index(e[0], e[1], e[2]);
    const std::vector<Real> weights =
        multiplied(exact.lower, exact.inverse, exact.exponents, {axis, parent, first, k});
    Recurrence recurrence{axis, parent, first, Eigen::VectorXd(k - first), rounded(weights.back())};
    for (int j = 0; j < k - first; ++j) recurrence.weights[j] = rounded(weights[at(j)]);
    recurrences.push_back(std::move(recurrence));
  }
}

template <class Real>
void PolynomialBasis::Parts::make_derivatives(const ExactParts<Real>& exact) {
  std::array<Eigen::MatrixXd, 3> local;
  for (int j = 0; j < 3; ++j)
    local[at(j)] = derivative_matrix(exact.lower, exact.inverse, order, j) / half_size[j];
  for (int i = 0; i < 3; ++i)
    derivatives[at(i)] = axes(i, 0) * local[0] + axes(i, 1) * local[1] + axes(i, 2) * local[2];
}

template <class Real>
void PolynomialBasis::Parts::make_identity_map(const ExactParts<Real>& exact) {
  // seed = L phi: the coefficients of a seed are a row of L. X - c = inverse(A') (m + h xi), xi = seeds 1
  // to 3.
  const RealMatrix<Real> back = exact.axes.transpose().inverse();
  const RealMatrix<Real>& lower = exact.lower;
  identity_map = Eigen::MatrixX3d::Zero(polynomial_count(order), 3);
  for (int i = 0; i < 3; ++i) {
    if (order == 0) {
      identity_map(0, i) = centroid[i] * rounded(lower(0, 0));
      continue;
    }
    Real offset = 0;
    for (int j = 0; j < 3; ++j) offset += back(i, j) * Real(middle[j]);
    std::array<Real, 4> coefficients = {offset * lower(0, 0), Real(0), Real(0), Real(0)};
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k <= 1 + j; ++k)
        coefficients[at(k)] += back(i, j) * Real(half_size[j]) * lower(1 + j, k);
    }
    for (int k = 0; k < 4; ++k) identity_map(k, i) = rounded(coefficients[at(k)]);
  }
}

template <class Real>
void PolynomialBasis::Parts::measure_loss(const TriangleMesh& mesh, const ExactParts<Real>& exact) {
  int worst_degree = order + 1;
  // Points of the mesh are exact in many digits and in double precision.
  const std::size_t stride = (exact.points.size() + most_points_of_loss - 1) / most_points_of_loss;
  for (std::size_t n = 0; n < exact.points.size(); n += stride) {
    const std::vector<Real> seeds = seed_values(exact.points[n], order);
    const Vector3 xi =
        (axes.transpose() * (mesh.points[n] - mesh.points.front()) - middle).cwiseQuotient(half_size);
    const Eigen::VectorXd in_double = values(xi);
    for (int k = 0; k < polynomial_count(order); ++k) {
      Real value = 0;
      for (int j = 0; j <= k; ++j) value += exact.inverse(k, j) * seeds[at(j)];
      const double lost = std::abs(rounded(Real(Real(in_double[k]) - value))) * std::sqrt(volume);
      loss = std::max(loss, lost);
      const auto& e = exact.exponents[at(k)];
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

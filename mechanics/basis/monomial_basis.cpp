#include "mechanics/basis/monomial_basis.hpp"

#include "geometry/index.hpp"
#include "mechanics/basis/moments.hpp"

namespace ashlar {
namespace {

/// Centroid and half the diagonal of the box.
std::pair<Vector3, double> middle_and_size(const TriangleMesh& mesh) {
  Vector3 low = mesh.points.front();
  Vector3 high = low;
  for (const Vector3& point : mesh.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const std::vector<double> first = moments(mesh, 1);
  return {Vector3(first[1], first[2], first[3]) / first[0], 0.5 * (high - low).norm()};
}

double power(double x, int exponent) {
  double result = 1.0;
  for (int k = 0; k < exponent; ++k) result *= x;
  return result;
}

}  // namespace

MonomialBasis::MonomialBasis(const Polyhedron& solid, int order, MonomialOrigin origin)
    : order_(order), exponents_(monomial_exponents(order)) {
  TriangleMesh mesh = solid.mesh();
  if (origin != MonomialOrigin::global) {
    const auto [middle, size] = middle_and_size(mesh);
    center_ = middle;
    if (origin == MonomialOrigin::scaled) unit_ = size;
  }
  for (Vector3& point : mesh.points) point = (point - center_) / unit_;
  moments_ = moments(mesh, 2 * order);
  for (double& moment : moments_) moment *= unit_ * unit_ * unit_;
}

Eigen::MatrixXd MonomialBasis::values(const std::vector<Vector3>& points) const {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(points.size()), size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vector3 x = (points[n] - center_) / unit_;
    for (int k = 0; k < size(); ++k) {
      const auto& [a, b, c] = exponents_[at(k)];
      result(static_cast<Eigen::Index>(n), k) = power(x.x(), a) * power(x.y(), b) * power(x.z(), c);
    }
  }
  return result;
}

Eigen::MatrixXd MonomialBasis::gram() const {
  Eigen::MatrixXd result(size(), size());
  for (int r = 0; r < size(); ++r) {
    for (int s = 0; s < size(); ++s) {
      const auto& p = exponents_[at(r)];
      const auto& q = exponents_[at(s)];
      result(r, s) = moments_[at(monomial_index(p[0] + q[0], p[1] + q[1], p[2] + q[2]))];
    }
  }
  return result;
}

Eigen::VectorXd MonomialBasis::integrals() const {
  return Eigen::Map<const Eigen::VectorXd>(moments_.data(), size());
}

double MonomialBasis::gradient_product(int r, int i, int s, int j) const {
  auto p = exponents_[at(r)];
  auto q = exponents_[at(s)];
  const int factor = p[at(i)] * q[at(j)];
  if (factor == 0) return 0.0;
  --p[at(i)];
  --q[at(j)];
  return factor * moments_[at(monomial_index(p[0] + q[0], p[1] + q[1], p[2] + q[2]))] / (unit_ * unit_);
}

Eigen::MatrixXd MonomialBasis::stiffness(const Material& material) const {
  const int p = size();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * p, 3 * p);
  for (int r = 0; r < p; ++r) {
    for (int s = 0; s < p; ++s) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          const double product = gradient_product(r, i, s, j);
          result(i * p + r, j * p + s) += material.lame_lambda() * product;
          result(j * p + r, i * p + s) += material.lame_mu() * product;
          for (int k = 0; i == j && k < 3; ++k) result(k * p + r, k * p + s) += material.lame_mu() * product;
        }
      }
    }
  }
  return result;
}

}  // namespace ashlar

#include "mechanics/material/st_venant_kirchhoff.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "geometry/index.hpp"
#include "mechanics/basis/quadrature.hpp"
#include "mechanics/material/symmetric_components.hpp"

namespace ashlar {
namespace {

/// Candidates for each point that determines polynomials: fewer determine them worse, more take longer.
constexpr std::size_t candidates_of_point = 4;
/// Of the points of a rule, from one candidate to the next: the golden section in thousandths scatters them over the rule,
/// whose order has a pattern.
constexpr std::size_t golden_thousandths = 618;

/// Multiplicity of a component in a double sum over J and K.
double multiplicity(std::size_t c) {
  return c < 3 ? 1.0 : 2.0;
}

/// Points that determine polynomials of a basis best: approximate Fekete points (Sommariva and Vianello 2009) among
/// those of a quadrature rule, as many as the basis has functions.
std::vector<Vector3> unisolvent_points(const Polyhedron& solid, const PolynomialBasis& wide) {
  const VolumeRule rule = volume_rule(solid.mesh(), wide.centroid(), 2 * wide.order());
  const auto count = static_cast<std::size_t>(wide.size());
  const std::size_t all = rule.points.size();
  std::size_t step = std::max<std::size_t>(1, all * golden_thousandths / 1000);
  while (std::gcd(step, all) != 1) ++step;
  std::vector<Vector3> candidates;
  for (std::size_t k = 0; k < std::min(all, candidates_of_point * count); ++k)
    candidates.push_back(rule.points[k * step % all]);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(wide.values(candidates).transpose());
  if (qr.rank() < wide.size())
    throw std::invalid_argument("the shape is too thin for st-venant-kirchhoff at this order");
  std::vector<Vector3> points;
  for (std::size_t k = 0; k < count; ++k)
    points.push_back(candidates[at(qr.colsPermutation().indices()[static_cast<Eigen::Index>(k)])]);
  return points;
}

}  // namespace

StVenantKirchhoff::StVenantKirchhoff(const Polyhedron& solid, const PolynomialBasis& basis,
                                     const Material& material)
    : lambda_(material.lame_lambda()), mu_(material.lame_mu()) {
  if (basis.order() > max_order)
    throw std::invalid_argument("st-venant-kirchhoff is available for orders up to " +
                                std::to_string(max_order));
  const PolynomialBasis wide(solid, std::max(0, 2 * (basis.order() - 1)));
  const std::vector<Vector3> points = unisolvent_points(solid, wide);
  const Eigen::MatrixXd phi = basis.values(points);
  for (int axis = 0; axis < 3; ++axis)
    gradients_[at(axis)].noalias() = phi * basis.derivative(axis).transpose();
  to_coefficients_ = wide.values(points).partialPivLu().inverse();
}

std::array<Eigen::MatrixX3d, 3> StVenantKirchhoff::deformation(const Eigen::MatrixX3d& coefficients) const {
  return {gradients_[0] * coefficients, gradients_[1] * coefficients, gradients_[2] * coefficients};
}

StVenantKirchhoff::Tensor StVenantKirchhoff::strain(const std::array<Eigen::MatrixX3d, 3>& f) const {
  Tensor result;
  for (std::size_t c = 0; c < symmetric_components.size(); ++c) {
    const auto [j, k] = symmetric_components[c];
    Eigen::VectorXd values = 0.5 * f[at(j)].cwiseProduct(f[at(k)]).rowwise().sum();
    if (j == k) values.array() -= 0.5;
    result[c].noalias() = to_coefficients_ * values;
  }
  return result;
}

StVenantKirchhoff::Tensor StVenantKirchhoff::weighted_stress(const Tensor& strain) const {
  const Eigen::VectorXd trace = strain[0] + strain[1] + strain[2];
  Tensor result;
  for (std::size_t c = 0; c < symmetric_components.size(); ++c) {
    Eigen::VectorXd stress = 2.0 * mu_ * strain[c];
    if (c < 3) stress += lambda_ * trace;
    result[c].noalias() = to_coefficients_.transpose() * stress;
  }
  return result;
}

ElasticResponse StVenantKirchhoff::respond(const Eigen::MatrixX3d& coefficients) const {
  const auto f = deformation(coefficients);
  const Tensor e = strain(f);
  const Tensor s = weighted_stress(e);
  ElasticResponse response;
  response.rotation.setIdentity();
  response.energy = 0.5 * lambda_ * (e[0] + e[1] + e[2]).squaredNorm();
  std::array<Eigen::MatrixX3d, 3> flux;  // sum over J of S_JK F_iJ
  for (auto& part : flux) part.setZero(f[0].rows(), 3);
  for (std::size_t c = 0; c < symmetric_components.size(); ++c) {
    const auto [j, k] = symmetric_components[c];
    response.energy += multiplicity(c) * mu_ * e[c].squaredNorm();
    flux[at(k)] += s[c].asDiagonal() * f[at(j)];
    if (j != k) flux[at(j)] += s[c].asDiagonal() * f[at(k)];
  }
  response.force = gradients_[0].transpose() * flux[0];
  response.force += gradients_[1].transpose() * flux[1];
  response.force += gradients_[2].transpose() * flux[2];
  return response;
}

Eigen::MatrixXd StVenantKirchhoff::tangent(const Eigen::MatrixX3d& coefficients, bool without_stress) const {
  const auto f = deformation(coefficients);
  const Eigen::Index p = coefficients.rows();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * p, 3 * p);
  Eigen::MatrixXd trace = Eigen::MatrixXd::Zero(f[0].rows(), 3 * p);
  Eigen::MatrixXd change(f[0].rows(), 3 * p);  // of E_JK at the points with q
  Eigen::MatrixXd spectrum(f[0].rows(), 3 * p);
  for (std::size_t c = 0; c < symmetric_components.size(); ++c) {
    const auto [j, k] = symmetric_components[c];
    for (Eigen::Index i = 0; i < 3; ++i) {
      change.middleCols(i * p, p) = 0.5 * (f[at(j)].col(i).asDiagonal() * gradients_[at(k)]);
      change.middleCols(i * p, p) += 0.5 * (f[at(k)].col(i).asDiagonal() * gradients_[at(j)]);
    }
    spectrum.noalias() = to_coefficients_ * change;
    if (c < 3) trace += spectrum;
    result.selfadjointView<Eigen::Lower>().rankUpdate(spectrum.transpose(), 2.0 * multiplicity(c) * mu_);
  }
  if (lambda_ > 0.0) result.selfadjointView<Eigen::Lower>().rankUpdate(trace.transpose(), lambda_);
  result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
  if (without_stress) return result;
  const Tensor s = weighted_stress(strain(f));
  Eigen::MatrixXd geometric = Eigen::MatrixXd::Zero(p, p);
  for (std::size_t c = 0; c < symmetric_components.size(); ++c) {
    const auto [j, k] = symmetric_components[c];
    const Eigen::MatrixXd part = gradients_[at(j)].transpose() * s[c].asDiagonal() * gradients_[at(k)];
    geometric += j == k ? part : Eigen::MatrixXd(part + part.transpose());
  }
  for (Eigen::Index i = 0; i < 3; ++i) result.block(i * p, i * p, p, p) += geometric;
  return result;
}

Eigen::Matrix3d st_venant_kirchhoff_stress(const Material& material, const Eigen::Matrix3d& f) {
  const Eigen::Matrix3d strain = 0.5 * (f.transpose() * f - Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d stress = material.lame_lambda() * strain.trace() * Eigen::Matrix3d::Identity() +
                                 2.0 * material.lame_mu() * strain;
  return f * stress * f.transpose() / f.determinant();
}

}  // namespace ashlar

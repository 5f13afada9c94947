#include "mechanics/material/elasticity.hpp"

#include <cmath>

namespace ashlar {
namespace {

Eigen::Matrix3d cross_matrix(const Vector3& v) {
  return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

}  // namespace

Eigen::MatrixXd elastic_stiffness(const PolynomialBasis& basis, const Material& material) {
  const Eigen::Index p = basis.size();
  const double lambda = material.lame_lambda();
  const double mu = material.lame_mu();
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3 * p, 3 * p);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      // integral of (d phi_a / dX_i)(d phi_b / dX_j) dV, because phi is orthonormal
      const Eigen::MatrixXd product = basis.derivative(i) * basis.derivative(j).transpose();
      stiffness.block(i * p, j * p, p, p) += lambda * product;
      stiffness.block(j * p, i * p, p, p) += mu * product;
      if (i == j) {
        for (int k = 0; k < 3; ++k) stiffness.block(k * p, k * p, p, p) += mu * product;
      }
    }
  }
  return stiffness;
}

Eigen::MatrixX3d mean_gradients(const PolynomialBasis& basis) {
  Eigen::MatrixX3d gradients(basis.size(), 3);
  const double root = std::sqrt(basis.volume());
  for (int axis = 0; axis < 3; ++axis) gradients.col(axis) = basis.derivative(axis).col(0) / root;
  return gradients;
}

PolarDecomposition polar_decomposition(const Eigen::Matrix3d& deformation_gradient) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(deformation_gradient,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  PolarDecomposition result;
  result.rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  result.stretch =
      svd.matrixV() * sign.cwiseProduct(svd.singularValues()).asDiagonal() * svd.matrixV().transpose();
  return result;
}

ElasticResponse elastic_response(const Eigen::MatrixXd& stiffness, const Eigen::MatrixX3d& gradients,
                                 const Eigen::MatrixX3d& reference, const Eigen::MatrixX3d& coefficients,
                                 bool corotational) {
  ElasticResponse response;
  response.rotation.setIdentity();
  const Eigen::Index p = coefficients.rows();
  PolarDecomposition polar;
  Eigen::MatrixX3d deformation;
  if (corotational) {
    polar = polar_decomposition(coefficients.transpose() * gradients);
    response.rotation = polar.rotation;
    deformation = coefficients * polar.rotation - reference;
  } else {
    deformation = coefficients - reference;
  }
  Eigen::MatrixX3d local(p, 3);
  Eigen::Map<Eigen::VectorXd>(local.data(), 3 * p).noalias() =
      stiffness * Eigen::Map<const Eigen::VectorXd>(deformation.data(), 3 * p);
  response.energy = 0.5 * local.cwiseProduct(deformation).sum();
  if (!corotational) {
    response.force = local;
    return response;
  }
  Vector3 torque = Vector3::Zero();
  for (Eigen::Index a = 0; a < p; ++a) {
    const Vector3 force = local.row(a);
    const Vector3 place = reference.row(a) + deformation.row(a);
    torque += force.cross(place);
  }
  const Eigen::Matrix3d inertia = polar.stretch.trace() * Eigen::Matrix3d::Identity() - polar.stretch;
  const Vector3 n = inertia.partialPivLu().solve(torque);
  response.force = (local + gradients * cross_matrix(n).transpose()) * polar.rotation.transpose();
  return response;
}

Eigen::MatrixXd rotated_stiffness(const Eigen::MatrixXd& stiffness, const Eigen::Matrix3d& rotation) {
  const Eigen::Index p = stiffness.rows() / 3;
  Eigen::MatrixXd half = Eigen::MatrixXd::Zero(3 * p, 3 * p);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * p, 3 * p);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) half.middleRows(i * p, p) += rotation(i, k) * stiffness.middleRows(k * p, p);
  }
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) result.middleCols(j * p, p) += rotation(j, k) * half.middleCols(k * p, p);
  }
  return result;
}

Eigen::Matrix3d linear_stress(const Material& material, const Eigen::Matrix3d& displacement_gradient,
                              const Eigen::Matrix3d& rotation) {
  const Eigen::Matrix3d strain = 0.5 * (displacement_gradient + displacement_gradient.transpose());
  const Eigen::Matrix3d stress = material.lame_lambda() * strain.trace() * Eigen::Matrix3d::Identity() +
                                 2.0 * material.lame_mu() * strain;
  return rotation * stress * rotation.transpose();
}

}  // namespace ashlar

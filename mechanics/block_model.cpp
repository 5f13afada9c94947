#include "mechanics/block_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ashlar {

BlockModel::BlockModel(BlockDefinition definition)
    : definition_(std::move(definition)),
      basis_(*definition_.solid, definition_.fixed ? 1 : definition_.order),
      space_(basis_.size()) {
  if (fixed()) return;
  space_ = AdmissibleSpace(solid(), basis_, definition_.supports);
  mean_gradients_ = mean_gradients(basis_);
  stiffness_ = elastic_stiffness(basis_, material());
  if (!corotational()) reduced_stiffness_ = space_.restrict(stiffness_);
  if (material().elasticity == Elasticity::st_venant_kirchhoff)
    large_ = std::make_shared<const StVenantKirchhoff>(solid(), basis_, material());
  for (const Load& load : definition_.loads) loads_.push_back(load_coefficients(solid(), basis_, load));
}

BlockState BlockModel::initial_state() const {
  return {basis_.identity_map(), Eigen::MatrixX3d::Zero(basis_.size(), 3)};
}

Eigen::MatrixX3d BlockModel::rigid_velocity(const Vector3& velocity, const Vector3& angular_velocity) const {
  Eigen::Matrix3d spin;
  for (int k = 0; k < 3; ++k) spin.col(k) = angular_velocity.cross(Vector3::Unit(k));
  return space_.expand(space_.restrict(basis_.linear_field(velocity, spin)));
}

Eigen::MatrixX3d BlockModel::external_force(const Vector3& gravity, double time) const {
  Eigen::MatrixX3d force = load_force(time);
  // integral of phi_a dV is sqrt(V) for a = 0 and zero for the others
  force.row(0) += material().density * std::sqrt(basis_.volume()) * gravity.transpose();
  return force;
}

Eigen::MatrixX3d BlockModel::load_force(double time) const {
  Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(basis_.size(), 3);
  for (std::size_t k = 0; k < loads_.size(); ++k) force += definition_.loads[k].history.at(time) * loads_[k];
  return force;
}

bool BlockModel::loads_change_between(double start, double end) const {
  return std::any_of(definition_.loads.begin(), definition_.loads.end(),
                     [&](const Load& load) { return load.history.changes_between(start, end); });
}

ElasticResponse BlockModel::elastic(const Eigen::MatrixX3d& position) const {
  if (large_) return large_->respond(position);
  return elastic_response(stiffness_, mean_gradients_, basis_.identity_map(), position, corotational());
}

Eigen::MatrixXd BlockModel::tangent(const Eigen::Matrix3d& rotation) const {
  return corotational() ? space_.restrict(rotated_stiffness(stiffness_, rotation)) : reduced_stiffness_;
}

Eigen::MatrixXd BlockModel::tangent(const Eigen::MatrixX3d& position, const ElasticResponse& elastic,
                                    bool positive) const {
  return large_ ? space_.restrict(large_->tangent(position, positive)) : tangent(elastic.rotation);
}

Vector3 BlockModel::momentum(const BlockState& state) const {
  return material().density * std::sqrt(basis_.volume()) * state.velocity.row(0).transpose();
}

Vector3 BlockModel::angular_momentum(const BlockState& state) const {
  Vector3 sum = Vector3::Zero();
  for (Eigen::Index a = 0; a < state.position.rows(); ++a) {
    const Vector3 place = state.position.row(a);
    const Vector3 velocity = state.velocity.row(a);
    sum += place.cross(velocity);
  }
  return material().density * sum;
}

double BlockModel::kinetic_energy(const BlockState& state) const {
  return 0.5 * material().density * state.velocity.squaredNorm();
}

double BlockModel::gravity_energy(const BlockState& state, const Vector3& gravity) const {
  return -material().density * std::sqrt(basis_.volume()) * state.position.row(0).dot(gravity);
}

Eigen::Matrix3d BlockModel::stress(const BlockState& state, const Vector3& point) const {
  if (fixed()) return Eigen::Matrix3d::Zero();
  if (large_)
    return st_venant_kirchhoff_stress(material(), state.position.transpose() * basis_.gradients(point));
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (corotational()) rotation = polar_decomposition(state.position.transpose() * mean_gradients_).rotation;
  const Eigen::MatrixX3d deformation = state.position * rotation - basis_.identity_map();
  return linear_stress(material(), deformation.transpose() * basis_.gradients(point), rotation);
}

}  // namespace ashlar

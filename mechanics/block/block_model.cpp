#include "mechanics/block/block_model.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "geometry/exact/rounded_functions.hpp"
#include "mechanics/basis/field_moments.hpp"

namespace ashlar {
namespace {

std::shared_ptr<const IncrementalForm> form_of(const BlockDefinition& definition) {
  if (definition.fixed || definition.formulation == Formulation::total) return nullptr;
  return std::make_shared<const IncrementalForm>(definition);
}

}  // namespace

BlockModel::BlockModel(BlockDefinition definition)
    : BlockModel([&] {
        BlockPartsLibrary library;
        return BlockModel(std::move(definition), library);
      }()) {}

BlockModel::BlockModel(BlockDefinition definition, BlockPartsLibrary& library)
    : BlockModel([&] {
        const auto form = form_of(definition);
        if (!form) {
          const auto found = library.find(definition);
          return BlockModel(std::move(definition), nullptr, {}, found);
        }
        CarriedShape start = form->start();
        BlockDefinition now = form->definition_at(start);
        const auto found = library.find(now);
        return BlockModel(std::move(now), form, std::move(start), found);
      }()) {}

BlockModel::BlockModel(BlockDefinition definition, std::shared_ptr<const IncrementalForm> form,
                       CarriedShape carried, const BlockPartsLibrary::Found& found)
    : definition_(std::move(definition)),
      basis_(found.basis),
      size_(correctly_rounded::cbrt(basis_.volume())),
      parts_(found.parts),
      form_(std::move(form)),
      carried_(std::move(carried)) {
  if (fixed()) return;
  if (rigid() && (form_ || supported()))
    throw std::invalid_argument("a rigid block has no supports, and no incremental form");
  natural_ = basis_.identity_map();
  if (definition_.initial_stress && !rigid()) {
    if (form_ || parts_->large)
      throw std::invalid_argument("initial stress needs linear elasticity and the total formulation");
    natural_ -= initial_deformation(solid(), basis_, parts_->stiffness, definition_.initial_stress);
  }
  motion_ = SupportMotion(solid(), basis_, definition_.supports);
  for (const Load& load : definition_.loads) loads_.push_back(load_coefficients(solid(), basis_, load));
  if (quiet()) start_quiet_faces();
}

void BlockModel::start_quiet_faces() {
  if (form_ || rigid() || driven())
    throw std::invalid_argument(
        "quiet faces need order >= 1, the total formulation and supports of the block at rest");
  if (!definition_.released) return;
  dashpots_ = std::make_shared<const Eigen::MatrixXd>(
      space().restrict(dashpot_matrix(solid(), basis_, material(), definition_.quiet)));
  for (const QuietFaces& quiet : definition_.quiet)
    for (const Load& load : quiet.driving)
      driving_.push_back({load_coefficients(solid(), basis_, load), load.history});
}

BlockModel BlockModel::with_quiet_faces(bool released, BlockPartsLibrary& library) const {
  BlockDefinition definition = definition_;
  definition.released = released;
  return {std::move(definition), library};
}

void BlockModel::set_reaction(Eigen::MatrixX3d reaction) {
  if (!dashpots_ || reaction.rows() != basis_.size())
    throw std::invalid_argument("a reaction belongs to released quiet faces, and has their block's order");
  reaction_ = std::move(reaction);
}

BlockModel BlockModel::with_order(int order) const {
  BlockPartsLibrary library;
  return with_order(order, library);
}

BlockModel BlockModel::with_order(int order, BlockPartsLibrary& library) const {
  if (fixed() || form_ || rigid() || order < 1)
    throw std::invalid_argument(
        "only a moving block of the total formulation changes order, and none to rigid");
  if (dashpots_)
    throw std::invalid_argument(
        "the reaction of quiet faces is of one order: change it before motion begins");
  BlockDefinition definition = definition_;
  definition.order = order;
  return {std::move(definition), library};
}

BlockModel BlockModel::with_shape(CarriedShape shape) const {
  BlockDefinition now = form_->definition_at(shape);
  BlockPartsLibrary library;
  const auto found = library.find(now);
  return {std::move(now), form_, std::move(shape), found};
}

CarriedBlock BlockModel::carried_on(const Eigen::MatrixX3d& position) const {
  const Eigen::MatrixX3d change = position - basis_.identity_map();
  CarriedShape shape = carried_;
  const auto move = [&](std::vector<Vector3>& points) {
    if (points.empty()) return;
    const Eigen::MatrixX3d motion = basis_.values(points) * change;
    for (std::size_t k = 0; k < points.size(); ++k) points[k] += motion.row(static_cast<Eigen::Index>(k));
  };
  move(shape.points);
  move(shape.followed);
  CarriedBlock next{with_shape(std::move(shape)), {}};
  Vector3 shift = next.model.basis().centroid() - basis_.centroid();
  for (int axis = 0; axis < 3; ++axis) {
    if (!space().free_along(axis)) shift[axis] = 0.0;
  }
  next.re_expansion = re_expansion(basis_, next.model.basis(), shift);
  next.model.carried_.stress =
      next.re_expansion * (carried_.stress + added_stress(basis_, material(), change));
  return next;
}

Eigen::MatrixX3d CarriedBlock::taken_over(const Eigen::MatrixX3d& field) const {
  const Eigen::MatrixX3d moved = re_expansion * field;
  return model.space().expand(model.space().restrict(moved));
}

BlockState BlockModel::initial_state() const {
  return {basis_.identity_map(), Eigen::MatrixX3d::Zero(basis_.size(), 3)};
}

Eigen::MatrixX3d BlockModel::rigid_velocity(const Vector3& velocity, const Vector3& angular_velocity) const {
  Eigen::Matrix3d spin;
  for (int k = 0; k < 3; ++k) spin.col(k) = angular_velocity.cross(Vector3::Unit(k));
  return space().expand(space().restrict(basis_.linear_field(velocity, spin)));
}

Eigen::MatrixX3d BlockModel::external_force(const Vector3& gravity, double time) const {
  Eigen::MatrixX3d force = load_force(time);
  // integral of phi_a dV is sqrt(V) for a = 0 and zero for the others
  force.row(0) += material().density * std::sqrt(basis_.volume()) * gravity.transpose();
  return force;
}

Eigen::MatrixX3d BlockModel::load_force(double time) const {
  Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(basis_.size(), 3);
  for (std::size_t k = 0; k < loads_.size(); ++k)
    force += definition_.loads[k].factor * definition_.loads[k].history.at(time) * loads_[k];
  for (const auto& [wave, history] : driving_) force += history.at(time) * wave;
  if (reaction_.size() > 0) force += reaction_;
  return force;
}

Eigen::MatrixX3d BlockModel::prescribed_change(const Eigen::MatrixX3d& position, double from,
                                               double to) const {
  if (!driven()) return {};
  if (form_) return motion_.at(to) - motion_.at(from);
  // Relative to the supports, so that rounding errors do not accumulate over steps.
  const Eigen::MatrixX3d displacement = position - basis_.identity_map();
  return motion_.at(to) - (displacement - space().expand(space().restrict(displacement)));
}

Eigen::MatrixX3d BlockModel::prescribed_velocity(const Eigen::MatrixX3d& change, double from,
                                                 double step) const {
  if (motion_.has_velocity()) return motion_.velocity(from, step);
  return change / step;
}

bool BlockModel::loads_change_between(double start, double end) const {
  if (motion_.changes_between(start, end)) return true;
  if (std::any_of(driving_.begin(), driving_.end(),
                  [&](const Driving& wave) { return wave.history.changes_between(start, end); }))
    return true;
  return std::any_of(definition_.loads.begin(), definition_.loads.end(),
                     [&](const Load& load) { return load.history.changes_between(start, end); });
}

ElasticResponse BlockModel::elastic(const Eigen::MatrixX3d& position) const {
  if (rigid()) {
    const Eigen::Matrix3d rotation =
        polar_decomposition(position.transpose() * parts_->mean_gradients).rotation;
    return {0.0, Eigen::MatrixX3d::Zero(basis_.size(), 3), rotation};
  }
  if (parts_->large) return parts_->large->respond(position);
  if (form_)
    return incremental_response(basis_, material(), carried_.stress, position - basis_.identity_map());
  return elastic_response(parts_->stiffness, parts_->mean_gradients, natural_, position, corotational());
}

Eigen::MatrixX3d BlockModel::rigid_position(const Eigen::MatrixX3d& position) const {
  Eigen::MatrixX3d result = unstrained(position);
  result.row(0) = position.row(0);
  return result;
}

Eigen::MatrixX3d BlockModel::unstrained(const Eigen::MatrixX3d& position) const {
  if (!parts_->turns) return basis_.identity_map();
  const Eigen::Matrix3d gradient = position.transpose() * parts_->mean_gradients;
  return basis_.identity_map() * polar_decomposition(gradient).rotation.transpose();
}

Eigen::MatrixXd BlockModel::tangent(const Eigen::Matrix3d& rotation) const {
  if (rigid()) return Eigen::MatrixXd::Zero(unknowns(), unknowns());
  return corotational() ? space().restrict(rotated_stiffness(parts_->stiffness, rotation))
                        : parts_->reduced_stiffness;
}

Eigen::VectorXd BlockModel::tangent_times(const Eigen::Matrix3d& rotation, const Eigen::VectorXd& y) const {
  if (rigid()) return Eigen::VectorXd::Zero(unknowns());
  if (!corotational()) return parts_->reduced_stiffness * y;
  const Eigen::MatrixX3d turned_back = space().expand(y) * rotation;
  Eigen::MatrixX3d force(turned_back.rows(), 3);
  Eigen::Map<Eigen::VectorXd>(force.data(), force.size()).noalias() =
      parts_->stiffness * Eigen::Map<const Eigen::VectorXd>(turned_back.data(), turned_back.size());
  return space().restrict(Eigen::MatrixX3d(force * rotation.transpose()));
}

Eigen::MatrixXd BlockModel::tangent(const Eigen::MatrixX3d& position, const ElasticResponse& elastic,
                                    bool positive) const {
  return parts_->large ? space().restrict(parts_->large->tangent(position, positive))
                       : tangent(elastic.rotation);
}

Vector3 BlockModel::momentum(const BlockState& state) const {
  return material().density * std::sqrt(basis_.volume()) * state.velocity.row(0).transpose();
}

Vector3 BlockModel::angular_momentum(const BlockState& state) const {
  return material().density * integral_of_cross(state.position, state.velocity);
}

double BlockModel::kinetic_energy(const BlockState& state) const {
  return 0.5 * material().density * state.velocity.squaredNorm();
}

double BlockModel::gravity_energy(const BlockState& state, const Vector3& gravity) const {
  return -material().density * std::sqrt(basis_.volume()) * state.position.row(0).dot(gravity);
}

std::vector<Eigen::Matrix3d> BlockModel::stresses(const BlockState& state, const Eigen::MatrixXd& phi) const {
  std::vector<Eigen::Matrix3d> result(static_cast<std::size_t>(phi.rows()), Eigen::Matrix3d::Zero());
  if (fixed() || rigid()) return result;
  if (form_) {
    const Eigen::MatrixX3d change = state.position - basis_.identity_map();
    const Eigen::MatrixXd stress = carried_.stress + added_stress(basis_, material(), change);
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] = incremental_stress(stress, phi.row(static_cast<Eigen::Index>(k)));
    return result;
  }
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (corotational())
    rotation = polar_decomposition(state.position.transpose() * parts_->mean_gradients).rotation;
  // d phi / dX_i = D_i phi: the derivative of a field of coefficients c is one of coefficients D_i' c.
  Eigen::MatrixX3d field = state.position;
  if (!parts_->large) field = state.position * rotation - natural_;
  std::array<Eigen::MatrixX3d, 3> derivatives;  // (#points, 3), by axes of X
  for (int axis = 0; axis < 3; ++axis)
    derivatives[static_cast<std::size_t>(axis)] =
        phi * (basis_.derivative(axis).triangularView<Eigen::Lower>().transpose() * field);
  for (std::size_t k = 0; k < result.size(); ++k) {
    Eigen::Matrix3d gradient;
    for (int axis = 0; axis < 3; ++axis)
      gradient.col(axis) =
          derivatives[static_cast<std::size_t>(axis)].row(static_cast<Eigen::Index>(k)).transpose();
    result[k] = parts_->large ? st_venant_kirchhoff_stress(material(), gradient)
                              : linear_stress(material(), gradient, rotation);
  }
  return result;
}

Eigen::Matrix3d BlockModel::stress(const BlockState& state, const Vector3& point) const {
  return stresses(state, basis_.values(std::vector<Vector3>{point})).front();
}

PointMotion BlockModel::motion_of(const BlockState& state, const Vector3& reference) const {
  return motions_of(state, {reference}).front();
}

std::vector<PointMotion> BlockModel::motions_of(const BlockState& state,
                                                const std::vector<Vector3>& references) const {
  std::vector<Vector3> starts = references;
  if (form_)
    for (Vector3& start : starts) start = form_->place(carried_, start);
  const Eigen::MatrixXd phi = basis_.values(starts);
  const Eigen::MatrixX3d moved = phi * (state.position - basis_.identity_map());
  const Eigen::MatrixX3d places = phi * state.position;
  const Eigen::MatrixX3d velocities = phi * state.velocity;
  const std::vector<Eigen::Matrix3d> stress = stresses(state, phi);
  std::vector<PointMotion> result;
  result.reserve(references.size());
  for (std::size_t k = 0; k < references.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const Vector3 move = moved.row(row).transpose();
    result.push_back({form_ ? Vector3(starts[k] + move) : Vector3(places.row(row).transpose()),
                      move + (starts[k] - references[k]), velocities.row(row).transpose(), stress[k]});
  }
  return result;
}

}  // namespace ashlar

#include "solver/step/impact/rigid_motions.hpp"

#include "geometry/index.hpp"
#include "mechanics/block/rigid_body.hpp"

namespace ashlar {
namespace {

/// Squared length of a rigid motion after restriction to the supports, of that before, from which on it is allowed: rounding
/// takes away less. A smaller value would allow motions that supports prevent in part.
constexpr double unrestricted = 1.0 - 1e-9;

/// Rigid motions that the supports of a block leave, orthonormal. @return (unknowns, at most 6)
Eigen::MatrixXd rigid_modes(const BlockModel& block, const BlockState& state) {
  const Eigen::MatrixXd fields = rigid_fields(state.position);
  Eigen::MatrixXd modes(block.unknowns(), fields.cols());
  for (Eigen::Index k = 0; k < fields.cols(); ++k)
    modes.col(k) = block.space().restrict(Eigen::MatrixX3d(fields.col(k).reshaped(fields.rows() / 3, 3)));
  if (!block.supported()) return modes;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(modes.transpose() * modes);
  const Eigen::Index lost = (parts.eigenvalues().array() < unrestricted).count();
  return modes * parts.eigenvectors().rightCols(modes.cols() - lost);
}

}  // namespace

const Eigen::MatrixXd& RigidMotions::modes(int block) {
  const auto [found, is_new] = modes_.emplace(block, Eigen::MatrixXd());
  if (is_new) found->second = rigid_modes(system_.blocks()[at(block)], states_[at(block)]);
  return found->second;
}

Eigen::VectorXd RigidMotions::velocity(int block) {
  const BlockModel& model = system_.blocks()[at(block)];
  if (!moves(block)) return Eigen::VectorXd::Zero(model.unknowns());
  const Eigen::MatrixXd& rigid = modes(block);
  return rigid * (rigid.transpose() * model.space().restrict(states_[at(block)].velocity));
}

Eigen::MatrixX3d RigidMotions::driven_velocity(int block) const {
  const BlockModel& model = system_.blocks()[at(block)];
  if (!model.driven()) return {};
  const Eigen::MatrixX3d& velocity = states_[at(block)].velocity;
  return model.fixed() ? velocity
                       : Eigen::MatrixX3d(velocity - model.space().expand(model.space().restrict(velocity)));
}

const Eigen::Matrix3Xd& RigidMotions::at_points(const ContactPair& pair) {
  const auto [found, is_new] = at_points_.emplace(&pair, Eigen::Matrix3Xd());
  if (!is_new) return found->second;
  PairRows rows = pair.rows();
  rows.prescribe(pair.points(), system_.blocks()[at(pair.a())], driven_velocity(pair.a()),
                 system_.blocks()[at(pair.b())], driven_velocity(pair.b()));
  found->second = rows.motion(velocity(pair.a()), velocity(pair.b()));
  return found->second;
}

Eigen::RowVectorXd RigidMotions::accelerations(const ContactPair& pair, const StepProblem& problem) const {
  const auto of = [&](int block) -> Eigen::VectorXd {
    const BlockModel& model = system_.blocks()[at(block)];
    if (!moves(block)) return Eigen::VectorXd::Zero(model.unknowns());
    return problem.bodies[at(block)].external_force / model.material().density;
  };
  return pair.rows().free_motion(of(pair.a()), of(pair.b())).row(0);
}

}  // namespace ashlar

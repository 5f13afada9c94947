#include "solver/step/impact/rigid_motions.hpp"

#include "geometry/index.hpp"
#include "mechanics/block/rigid_body.hpp"

namespace ashlar {
namespace {

/// Squared length of a rigid motion after restriction to the supports, of that before, from which on it is allowed: rounding
/// takes away less. A smaller value would allow motions that supports prevent in part.
constexpr double unrestricted = 1.0 - 1e-9;

SupportedMotions supported_motions(const BlockModel& block, const BlockState& state) {
  const Eigen::MatrixXd fields = rigid_fields(state.position);
  SupportedMotions motions;
  motions.free.resize(block.unknowns(), fields.cols());
  for (Eigen::Index k = 0; k < fields.cols(); ++k)
    motions.free.col(k) =
        block.space().restrict(Eigen::MatrixX3d(fields.col(k).reshaped(fields.rows() / 3, 3)));
  if (!block.supported()) return motions;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(motions.free.transpose() * motions.free);
  const Eigen::Index lost = (parts.eigenvalues().array() < unrestricted).count();
  motions.driven = fields * parts.eigenvectors().leftCols(lost);
  motions.shares = 1.0 - parts.eigenvalues().head(lost).array();
  motions.free *= parts.eigenvectors().rightCols(fields.cols() - lost);
  return motions;
}

}  // namespace

const SupportedMotions& RigidMotions::of(int block) {
  const auto [found, is_new] = motions_.try_emplace(block);
  if (is_new) found->second = supported_motions(system_.blocks()[at(block)], states_[at(block)]);
  return found->second;
}

Eigen::VectorXd RigidMotions::velocity(int block) {
  const BlockModel& model = system_.blocks()[at(block)];
  if (!moves(block)) return Eigen::VectorXd::Zero(model.unknowns());
  const Eigen::MatrixXd& rigid = modes(block);
  return rigid * (rigid.transpose() * model.space().restrict(states_[at(block)].velocity));
}

const Eigen::MatrixX3d& RigidMotions::driven_velocity(int block) {
  const auto [found, is_new] = driven_.emplace(block, Eigen::MatrixX3d());
  const BlockModel& model = system_.blocks()[at(block)];
  if (!is_new || !model.driven()) return found->second;
  const Eigen::MatrixX3d& velocity = states_[at(block)].velocity;
  if (model.fixed()) return found->second = velocity;
  // Components at supports say nothing of the rest of the block. The rigid motion that agrees with them does.
  const SupportedMotions& motions = of(block);
  const Eigen::MatrixX3d prescribed = velocity - model.space().expand(model.space().restrict(velocity));
  const Eigen::VectorXd rates =
      (motions.driven.transpose() * prescribed.reshaped()).cwiseQuotient(motions.shares);
  const Eigen::VectorXd rigid = motions.driven * rates;
  found->second =
      prescribed +
      model.space().expand(model.space().restrict(Eigen::MatrixX3d(rigid.reshaped(velocity.rows(), 3))));
  return found->second;
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

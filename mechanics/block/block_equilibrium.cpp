// Equilibrium of one block restrained by its supports: one linear solve, or for St.-Venant-Kirchhoff elasticity loads
// applied in parts, each with a Newton iteration that decreases the potential energy  E(q) - F . q.
#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "mechanics/block/block_model.hpp"

namespace ashlar {
namespace {

constexpr int load_parts = 8;
constexpr int max_iterations = 200;  ///< of one part
constexpr int max_halvings = 30;
/// Relative to the load: convergence, and convergence of a stalled iteration.
constexpr double force_tolerance = 1e-12;
constexpr double stalled_tolerance = 1e-9;
/// Residual over the last one above which an iteration stalls; a step that reduces it more is long enough.
constexpr double stalling = 0.5;
/// Decrease of energy over that of the linear model, from which on a step is long enough: larger values shorten good steps.
constexpr double energy_decrease = 0.1;
/// Rounding errors of a term of a force: larger values accept larger residuals.
constexpr double operations_of_force = 8.0;

/// Descent direction of the energy: Newton's, or without the stress's part if that is not convex.
std::optional<Eigen::VectorXd> newton_direction(const BlockModel& block, const Eigen::MatrixX3d& position,
                                                const ElasticResponse& elastic,
                                                const Eigen::VectorXd& residual) {
  for (const bool positive : {false, true}) {
    const Eigen::LLT<Eigen::MatrixXd> factor(block.tangent(position, elastic, positive));
    if (factor.info() == Eigen::Success) return factor.solve(residual);
  }
  return std::nullopt;
}

/// Solves for the equilibrium of a block under a force. @param y unknowns, initial guess and solution
bool balance(const BlockModel& block, const Eigen::VectorXd& force, double rounding, Eigen::VectorXd& y) {
  const auto place = [&](const Eigen::VectorXd& unknowns) {
    return Eigen::MatrixX3d(block.basis().identity_map() + block.space().expand(unknowns));
  };
  ElasticResponse elastic = block.elastic(place(y));
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const Eigen::VectorXd residual = force - block.space().restrict(elastic.force);
    const auto direction = newton_direction(block, place(y), elastic, residual);
    if (!direction) return false;
    const double slope = residual.dot(*direction);
    const double left = residual.norm();
    const bool last = left <= force_tolerance * force.norm() + rounding ||
                      (left <= stalled_tolerance * force.norm() && left > stalling * before);
    before = left;
    double share = 1.0;
    const double start = elastic.energy - force.dot(y);
    for (int halving = 0; halving < max_halvings; ++halving, share *= 0.5) {
      const Eigen::VectorXd next = y + share * *direction;
      elastic = block.elastic(place(next));
      // Near the solution the gain is below rounding error, but the residual still decreases.
      const bool enough = start - (elastic.energy - force.dot(next)) >= energy_decrease * share * slope ||
                          (force - block.space().restrict(elastic.force)).norm() <= stalling * left;
      if (last || enough) break;
    }
    y += share * *direction;
    if (last) return true;
  }
  return false;
}

}  // namespace

std::optional<Eigen::MatrixX3d> BlockModel::equilibrium(const Vector3& gravity, double time) const {
  if (fixed()) return basis_.identity_map();
  if (!space().held()) return std::nullopt;
  Eigen::VectorXd force = space().restrict(external_force(gravity, time));
  if (form_ || definition_.initial_stress) force -= space().restrict(elastic(basis_.identity_map()).force);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(unknowns());
  if (material().elasticity == Elasticity::linear) {
    const Eigen::LLT<Eigen::MatrixXd> factor(parts_->reduced_stiffness);
    if (factor.info() != Eigen::Success) return std::nullopt;
    y = factor.solve(force);
    y += factor.solve(force - parts_->reduced_stiffness * y);
  } else {
    for (int part = 1; part <= load_parts; ++part) {
      if (!balance(*this, force * part / load_parts, force_rounding(), y)) return std::nullopt;
    }
  }
  return Eigen::MatrixX3d(basis_.identity_map() + space().expand(y));
}

double BlockModel::force_rounding() const {
  if (rigid()) return 0.0;
  // The mean position cancels exactly in the force, so only the other coefficients have rounding errors. Supports leave them
  // in: a held block under an initial stress has forces on its unknowns that cancel.
  Eigen::MatrixX3d size = basis_.identity_map().cwiseAbs();
  size.row(0).setZero();
  if (form_)
    return operations_of_force * std::numeric_limits<double>::epsilon() *
           (tangent(Eigen::Matrix3d::Identity()).cwiseAbs() * space().restrict(size).cwiseAbs()).norm();
  size += (natural_ - basis_.identity_map()).cwiseAbs();
  return operations_of_force * std::numeric_limits<double>::epsilon() *
         (parts_->stiffness.cwiseAbs() * size.reshaped()).norm();
}

}  // namespace ashlar

#include "solver/step/island/lone_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ashlar {
namespace {

/// All directions are unknowns and turn with the block, or the frame does not turn.
bool shares_factors(const BlockModel& block) {
  return !block.rigid() && block.material().elasticity == Elasticity::linear &&
         block.incremental() == nullptr && (block.space().free() || !block.corotational());
}

/// R' f or R f for each coefficient of a free block. @param f (3p), stacked
Eigen::VectorXd turned(const Eigen::VectorXd& f, const Eigen::Matrix3d& turn) {
  const Eigen::Map<const Eigen::MatrixX3d> rows(f.data(), f.size() / 3, 3);
  const Eigen::MatrixX3d result = rows * turn.transpose();
  return result.reshaped();
}

}  // namespace

const Eigen::LLT<Eigen::MatrixXd>& LoneBodyFactors::find(const BlockModel& block, double stiffness_weight,
                                                         double mass) {
  ++counts_.solves;
  const auto key = std::tuple(block.parts().get(), stiffness_weight, mass);
  const auto found = entries_.find(key);
  if (found != entries_.end()) {
    ++counts_.factorizations_reused;
    found->second.used = true;
    return found->second.factor;
  }
  ++counts_.factorizations;
  Eigen::MatrixXd matrix = stiffness_weight * block.tangent(Eigen::Matrix3d::Identity());
  matrix.diagonal().array() += mass;
  Entry entry{block.parts(), Eigen::LLT<Eigen::MatrixXd>(matrix), true};
  return entries_.emplace(key, std::move(entry)).first->second.factor;
}

void LoneBodyFactors::drop_unused() {
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    const bool used = entry->second.used;
    entry->second.used = false;
    entry = used ? std::next(entry) : entries_.erase(entry);
  }
}

std::optional<IslandResult> solve_lone_body(BodyStep& body, const TimeScheme& scheme,
                                            const SimulationSettings& settings, LoneBodyFactors& factors) {
  const BlockModel& block = *body.model;
  if (body.dashpots != nullptr || !shares_factors(block)) return std::nullopt;
  const double mass = scheme.inertia * block.material().density;
  const double tolerance =
      scheme.is_static() ? settings.statics.residual_tolerance : settings.iteration.residual_tolerance;
  const Eigen::VectorXd external = scheme.force_weight * body.external_force;
  body.change = body.free_change;
  if (!scheme.is_static()) body.change += external / mass;
  IslandResult result;
  for (int k = 0; k <= settings.iteration.newton_iterations; ++k) {
    ++result.iterations;
    body.elastic = block.elastic(body.state->position + scheme.end_share * body.motion());
    const Eigen::VectorXd internal =
        scheme.force_weight * block.space().restrict(body.internal_force(scheme));
    const Eigen::VectorXd inertia = mass * (body.change - body.free_change);
    const Eigen::VectorXd left = external - internal - inertia;
    body.largest_force = std::max({external.norm(), internal.norm(), inertia.norm()});
    const double rounding = body.roundoff_force + 8.0 * std::numeric_limits<double>::epsilon() * mass *
                                                      (body.change.norm() + body.free_change.norm());
    if (!std::isfinite(body.largest_force)) return std::nullopt;
    // From rest, the residual of the initial guess is within the last iteration's bound of rounding errors, which is
    // wide.
    if (left.norm() <= tolerance * body.largest_force + rounding && !(scheme.is_static() && k == 0))
      return result;
    const double stiffness_weight = scheme.force_weight * scheme.end_share * (1.0 + scheme.stiffness_share);
    const auto& factor = factors.find(block, stiffness_weight, mass);
    if (factor.info() != Eigen::Success) return std::nullopt;
    if (block.corotational()) {
      const Eigen::Matrix3d& turn = body.elastic.rotation;
      body.change += turned(factor.solve(turned(left, turn.transpose())), turn);
    } else {
      body.change += factor.solve(left);
    }
  }
  return std::nullopt;
}

}  // namespace ashlar

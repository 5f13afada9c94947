#include "solver/step/impact/impact_splitting.hpp"

#include <optional>
#include <utility>

#include "solver/linear/splitting.hpp"

namespace ashlar {
namespace {

using Eigen::Vector3d;
using SplitImpulses = std::vector<Vector3d>;

/// Iterations from one residual to the next, and from one change of the penalty to the next: a change needs a new factor,
/// and the iterations after it forget the old one first.
constexpr int between_residuals = 10, between_penalties = 20;

class ImpactSplitting {
 public:
  explicit ImpactSplitting(const ImpactBodies& bodies) : bodies_(bodies), points_(bodies.points()) {
    factorize(1.0);
  }

  bool solve_bodies() {
    SplitImpulses loads;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const double shift = bodies_.point(k).friction * points_[k].copy.tail<2>().norm();
      points_[k].first = bodies_.given(k) + shift * Vector3d::UnitX();
      loads.push_back(points_[k].load());
    }
    const Eigen::VectorXd z = factor_->solve(bodies_.on_bodies(loads));
    for (std::size_t k = 0; k < points_.size(); ++k)
      points_[k].place = points_[k].first + bodies_.motion(k, z);
    return true;
  }
  void project_points() {
    relax_and_project(points_, [this](std::size_t k, const Vector3d& velocity, SplitPoint& point) {
      if (!(point.penalty[0] > 0.0)) return;
      const Vector3d impulse =
          lawful_impulse(bodies_.point(k), point.force - point.penalty.cwiseProduct(velocity)).value;
      point.copy = velocity + (impulse - point.force).cwiseQuotient(point.penalty);
      point.force = impulse;
    });
  }
  [[nodiscard]] SplitImpulses answer() const {
    SplitImpulses impulses;
    for (const SplitPoint& point : points_) impulses.push_back(point.force);
    return impulses;
  }
  [[nodiscard]] double residual() const { return bodies_.residual(answer()); }
  void adapt() {
    if (const double rho = adapted_rho(rho_, points_); rho != rho_) factorize(rho);
  }

 private:
  void factorize(double rho) {
    rho_ = rho;
    std::vector<Eigen::Matrix3d> springs;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (bodies_.mobility(k) > 0.0) points_[k].penalty.setConstant(1.0 / (rho_ * bodies_.mobility(k)));
      springs.emplace_back(points_[k].penalty.asDiagonal());
    }
    factor_.emplace(bodies_.factor(springs));
  }

  const ImpactBodies& bodies_;
  std::vector<SplitPoint> points_;
  double rho_ = 0.0;
  std::optional<ImpactFactor> factor_;
};

}  // namespace

FoundImpulses split_impulses(const ImpactBodies& bodies, double accuracy, int iterations) {
  ImpactSplitting splitting(bodies);
  auto found = solve_by_splitting<SplitImpulses>(splitting, {.passes = iterations,
                                                             .between_checks = between_residuals,
                                                             .enough = accuracy,
                                                             .between_changes = between_penalties});
  return {std::move(found.best), found.residual};
}

}  // namespace ashlar

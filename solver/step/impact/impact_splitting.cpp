#include "solver/step/impact/impact_splitting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace ashlar {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double over_relaxation = 1.6;
constexpr int iterations_between_checks = 10;
/// Checks between changes of rho, the ratio of changes that makes it change, and its factor.
constexpr int checks_between_changes = 2;
constexpr double unequal = 5.0, factor_of_rho = 2.0;
/// Limits of rho: extreme values follow a ratio that rounding decides.
constexpr double least_rho = 1e-6, most_rho = 1e3;

class PointSplitting {
 public:
  explicit PointSplitting(const ImpactBodies& bodies)
      : bodies_(bodies),
        stiffness_(bodies.points(), 0.0),
        impulses_(bodies.points(), Vector3d::Zero()),
        after_(bodies.points(), Vector3d::Zero()) {
    factorize();
  }

  void iterate() {
    std::vector<Vector3d> forces = impulses_;
    for (std::size_t k = 0; k < forces.size(); ++k) forces[k] += stiffness_[k] * (after_[k] - shifted(k));
    const VectorXd z = factor_->solve(bodies_.on_bodies(forces));
    gap_ = change_ = size_of_impulses_ = size_of_velocities_ = 0.0;
    for (std::size_t k = 0; k < bodies_.points(); ++k) {
      if (stiffness_[k] > 0.0) update(k, bodies_.motion(k, z) + shifted(k));
    }
  }

  /// Stiffens the springs if bodies and points differ by more than the points change, relative to velocities and
  /// impulses, and softens them in the opposite case.
  void adapt() {
    const double gap = std::sqrt(gap_ * size_of_impulses_);
    const double change = std::sqrt(change_ * size_of_velocities_);
    double rho = rho_;
    if (gap > unequal * change) rho /= factor_of_rho;
    if (change > unequal * gap) rho *= factor_of_rho;
    rho = std::clamp(rho, least_rho, most_rho);
    if (rho == rho_) return;
    rho_ = rho;
    factorize();
  }

  [[nodiscard]] const std::vector<Vector3d>& impulses() const { return impulses_; }

 private:
  void factorize() {
    for (std::size_t k = 0; k < bodies_.points(); ++k)
      if (bodies_.mobility(k) > 0.0) stiffness_[k] = 1.0 / (rho_ * bodies_.mobility(k));
    std::vector<Eigen::Matrix3d> springs;
    for (const double stiffness : stiffness_) springs.emplace_back(stiffness * Eigen::Matrix3d::Identity());
    factor_.emplace(bodies_.factor(springs));
  }

  [[nodiscard]] Vector3d shifted(std::size_t k) const {
    return bodies_.given(k) + bodies_.point(k).friction * after_[k].tail<2>().norm() * Vector3d::UnitX();
  }

  /// @param velocity of the point with the bodies, and its shift
  void update(std::size_t k, const Vector3d& velocity) {
    const double stiffness = stiffness_[k];
    const Vector3d relaxed = over_relaxation * velocity + (1.0 - over_relaxation) * after_[k];
    const Vector3d impulse = lawful_impulse(bodies_.point(k), impulses_[k] - stiffness * relaxed).value;
    const Vector3d after = relaxed + (impulse - impulses_[k]) / stiffness;
    // Energies, so that points of light and heavy bodies count alike.
    gap_ += (velocity - after).squaredNorm() * stiffness;
    change_ += (after - after_[k]).squaredNorm() * stiffness;
    size_of_impulses_ += impulse.squaredNorm() / stiffness;
    size_of_velocities_ += after.squaredNorm() * stiffness;
    impulses_[k] = impulse;
    after_[k] = after;
  }

  const ImpactBodies& bodies_;
  double rho_ = 1.0;
  std::vector<double> stiffness_;  ///< R by point, kg
  std::vector<Vector3d> impulses_, after_;
  std::optional<ImpactFactor> factor_;
  /// Of the last iteration, J: between the velocities of bodies and points, and of the points.
  double gap_ = 0.0, change_ = 0.0;
  double size_of_impulses_ = 0.0, size_of_velocities_ = 0.0;
};

}  // namespace

FoundImpulses split_impulses(const ImpactBodies& bodies, double accuracy, int iterations) {
  PointSplitting splitting(bodies);
  FoundImpulses best{splitting.impulses(), std::numeric_limits<double>::infinity()};
  for (int check = 1; check * iterations_between_checks <= iterations; ++check) {
    for (int k = 0; k < iterations_between_checks; ++k) splitting.iterate();
    best.take(bodies, splitting.impulses());
    if (!(best.residual > accuracy)) break;
    if (check % checks_between_changes == 0) splitting.adapt();
  }
  return best;
}

}  // namespace ashlar

#include "solver/step/impact/proximal_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ashlar {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double step_accuracy = 1e-12;  ///< of a solution by Newton's method, of the speed of the points
constexpr int passes_without_gain = 8;   ///< that end the passes
constexpr double gain = 0.5;
/// Newton's method in a pass with shifts of the last one, a convex function, and with its own, which may fail: iterations,
/// and halvings of a step.
constexpr int shifted_iterations = 60, shifted_halvings = 40;
constexpr int coulomb_iterations = 15, coulomb_halvings = 20;
/// Decrease that ends the halvings of a step, of that of the linear model: larger values shorten good steps.
constexpr double step_decrease = 1e-4;
/// Rounding error of the potential, relative to it.
constexpr double potential_rounding = 1e-14;

class ProximalPasses {
 public:
  ProximalPasses(const ImpactBodies& bodies, const FoundImpulses& start)
      : bodies_(bodies),
        best_(start),
        impulses_(start.impulses),
        shifts_(bodies.points(), 0.0),
        changes_(bodies.changes(start.impulses)) {}

  FoundImpulses run(const Compliance& compliance, double accuracy, int passes) {
    double last_gain = best_.residual;
    compliance_ = compliance.first;
    for (int pass = 0, idle = 0; pass < passes && idle < passes_without_gain && best_.residual > accuracy;
         ++pass) {
      if (!solve_coulomb()) solve_shifted();
      best_.take(bodies_, impulses_);
      ++idle;
      if (best_.residual < gain * last_gain) {
        last_gain = best_.residual;
        idle = 0;
      }
      compliance_ = std::max(compliance.least, compliance.factor * compliance_);
    }
    return best_;
  }

 private:
  [[nodiscard]] bool is_held(std::size_t k) const { return bodies_.mobility(k) > 0.0; }
  [[nodiscard]] double stiffness(std::size_t k) const { return 1.0 / (compliance_ * bodies_.mobility(k)); }
  /// Coulomb's shift of a point, m/s.
  [[nodiscard]] double shift_of(std::size_t k, const Vector3d& after) const {
    return bodies_.point(k).bonded ? 0.0 : bodies_.point(k).friction * after.tail<2>().norm();
  }
  [[nodiscard]] LawfulImpulse impulse_of(std::size_t k, const Vector3d& after, double shift) const {
    return lawful_impulse(bodies_.point(k),
                          impulses_[k] - stiffness(k) * (after + shift * Vector3d::UnitX()));
  }
  [[nodiscard]] double energy_norm(const VectorXd& z) const {
    return std::sqrt(z.dot(bodies_.inertia().cwiseProduct(z)));
  }
  [[nodiscard]] bool is_small(const VectorXd& step) const {
    return energy_norm(step) <= step_accuracy * bodies_.speed();
  }

  /// Function that solve_shifted() minimises, J.
  [[nodiscard]] double potential(const VectorXd& z) const {
    double sum = 0.5 * z.dot(bodies_.inertia().cwiseProduct(z));
    for (std::size_t k = 0; k < bodies_.points(); ++k)
      if (is_held(k))
        sum += 0.5 / stiffness(k) * impulse_of(k, bodies_.after(k, z), shifts_[k]).value.squaredNorm();
    return sum;
  }

  /// The pass with shifts of the last one.
  void solve_shifted() {
    for (std::size_t k = 0; k < bodies_.points(); ++k) shifts_[k] = shift_of(k, bodies_.after(k, changes_));
    std::vector<Vector3d> forces(bodies_.points(), Vector3d::Zero());
    std::vector<Matrix3d> slopes(bodies_.points(), Matrix3d::Zero());
    for (int k = 0; k < shifted_iterations; ++k) {
      for (std::size_t point = 0; point < bodies_.points(); ++point) {
        if (!is_held(point)) continue;
        const LawfulImpulse lawful = impulse_of(point, bodies_.after(point, changes_), shifts_[point]);
        forces[point] = lawful.value;
        slopes[point] = stiffness(point) * lawful.slope;
      }
      const VectorXd gradient = bodies_.inertia().cwiseProduct(changes_) - bodies_.on_bodies(forces);
      VectorXd step = -bodies_.factor(slopes).solve(gradient);
      const double decrease = -gradient.dot(step), before = potential(changes_);
      for (int n = 0; n < shifted_halvings; ++n, step *= 0.5) {
        const double least = step_decrease * std::ldexp(decrease, -n);
        if (potential(changes_ + step) <= before - least + potential_rounding * before) break;
      }
      changes_ += step;
      if (is_small(step)) break;
    }
    for (std::size_t k = 0; k < bodies_.points(); ++k)
      if (is_held(k)) impulses_[k] = impulse_of(k, bodies_.after(k, changes_), shifts_[k]).value;
  }

  /// Difference M z - sum of G' j+ of the pass with Coulomb's shift. @param forces j+. @param slopes -dj+/dw; null: not
  /// wanted
  VectorXd coulomb_residual(const VectorXd& z, std::vector<Vector3d>& forces,
                            std::vector<Matrix3d>* slopes) const {
    for (std::size_t k = 0; k < bodies_.points(); ++k) {
      if (!is_held(k)) continue;
      const Vector3d after = bodies_.after(k, z);
      const LawfulImpulse lawful = impulse_of(k, after, shift_of(k, after));
      forces[k] = lawful.value;
      if (slopes == nullptr) continue;
      Matrix3d shifting = Matrix3d::Identity();
      const double shear = after.tail<2>().norm();
      if (!bodies_.point(k).bonded && shear > 0.0)
        shifting.block<1, 2>(0, 1) += bodies_.point(k).friction / shear * after.tail<2>().transpose();
      (*slopes)[k] = stiffness(k) * lawful.slope * shifting;
    }
    return bodies_.inertia().cwiseProduct(z) - bodies_.on_bodies(forces);
  }
  [[nodiscard]] double size_of(const VectorXd& residual) const {
    return std::sqrt(residual.dot(residual.cwiseQuotient(bodies_.inertia())));
  }

  /// The pass with its own shifts. @return false if Newton's method fails: nothing has changed then
  bool solve_coulomb() {
    VectorXd z = changes_;
    std::vector<Vector3d> forces(bodies_.points(), Vector3d::Zero());
    std::vector<Matrix3d> slopes(bodies_.points(), Matrix3d::Zero());
    for (int k = 0; k < coulomb_iterations; ++k) {
      const VectorXd residual = coulomb_residual(z, forces, &slopes);
      VectorXd step = -bodies_.solve(slopes, residual);
      if (!step.allFinite()) return false;
      const double before = size_of(residual);
      int n = 0;
      for (double share = 1.0; n < coulomb_halvings; ++n, share *= 0.5, step *= 0.5)
        if (size_of(coulomb_residual(z + step, forces, nullptr)) <= (1.0 - step_decrease * share) * before)
          break;
      const bool ends = is_small(step);
      if (n == coulomb_halvings && !ends) return false;
      z += step;
      if (!ends) continue;
      changes_ = z;
      (void)coulomb_residual(z, forces, nullptr);
      impulses_ = forces;
      return true;
    }
    return false;
  }

  const ImpactBodies& bodies_;
  FoundImpulses best_;
  double compliance_ = 0.0;
  std::vector<Vector3d> impulses_;
  std::vector<double> shifts_;  ///< m/s
  VectorXd changes_;            ///< z
};

}  // namespace

FoundImpulses proximal_impulses(const ImpactBodies& bodies, const FoundImpulses& start,
                                const Compliance& compliance, double accuracy, int passes) {
  return ProximalPasses(bodies, start).run(compliance, accuracy, passes);
}

}  // namespace ashlar

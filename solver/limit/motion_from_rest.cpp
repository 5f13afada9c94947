#include <algorithm>
#include <array>
#include <utility>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "solver/limit/released_motion.hpp"

namespace ashlar {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Relative to the fastest point: residual of Coulomb's law in its velocity.
constexpr double coulomb_residual = 1e-2;
/// The same, for an exact solution.
constexpr double exact = 1e-11;
/// Total number of sweeps relative to those after which motion is certain.
constexpr int polished = 4;
/// Relative to the motion: its remaining share at the end, and the ratio of changes above which the limit is unknown.
constexpr double left_over = 0.8, slow_ratio = 0.9;
/// Relative to the motion: a smaller change from check to check is within rounding error, and has no ratio.
constexpr double no_decay = 1e-6;
/// Relative to the loads: smaller motion is rest.
constexpr double resting_motion = 1e-4;
/// Relative to the largest load: a body with less is compared with this one, as others move it. Smaller values report
/// motion of bodies nearly without load, larger ones miss that of small bodies.
constexpr double least_load = 1e-3;
constexpr int first_check = 64, most_sweeps = 4096;
/// Total number of updates of points: large models get fewer sweeps.
constexpr double most_updates = 1e7;
/// Iterations per update of a point: its force converges with those of its neighbours.
constexpr int local_steps = 3;

/// Data of a point in a sweep.
struct SweepPoint {
  std::array<int, 2> bodies;
  Matrix3d compliance;        ///< velocity by force
  double normal_step = 0.0;   ///< force by velocity
  double tangent_step = 0.0;  ///< the same
  double dilation = 0.0;
};

class Sweeps {
 public:
  Sweeps(const ConeProgram& program, const std::vector<double>& dilation,
         const std::vector<BodyVelocity>& load, std::vector<Vector3d> force)
      : program_(program), velocity_(load), force_(std::move(force)) {
    if (force_.empty()) force_.assign(program.points().size(), Vector3d::Zero());
    points_.reserve(program.points().size());
    for (const ConePair& pair : program.pairs())
      for (std::size_t k = pair.begin; k < pair.end; ++k) add(pair, k, dilation[k]);
  }

  /// Updates every point once, in the order of the points or in reverse order.
  void sweep(bool forth) {
    lack_ = fastest_ = 0.0;
    const std::size_t count = points_.size();
    for (std::size_t n = 0; n < count; ++n) update(forth ? n : count - 1 - n);
  }

  [[nodiscard]] double lack() const { return lack_; }        ///< largest violation of the last sweep
  [[nodiscard]] double fastest() const { return fastest_; }  ///< velocity of a point in the last sweep
  [[nodiscard]] std::vector<BodyVelocity>& velocity() { return velocity_; }
  [[nodiscard]] std::vector<Vector3d>& force() { return force_; }

 private:
  void add(const ConePair& pair, std::size_t k, double dilation) {
    const ConePoint& point = program_.points()[k];
    SweepPoint& p = points_.emplace_back();
    p.bodies = pair.bodies;
    p.compliance.setZero();
    if (pair.bodies[0] >= 0) p.compliance += point.first * point.first.transpose();
    if (pair.bodies[1] >= 0) p.compliance += point.second * point.second.transpose();
    const Matrix3d& w = p.compliance;
    const double largest =
        0.5 * (w(1, 1) + w(2, 2) + correctly_rounded::hypot(w(1, 1) - w(2, 2), 2.0 * w(1, 2)));
    // A body may have no motion along the normal or the tangents.
    p.normal_step = w(0, 0) > 0.0 ? 1.0 / w(0, 0) : 0.0;
    p.tangent_step = largest > 0.0 ? 1.0 / largest : 0.0;
    p.dilation = dilation;
    apply(k, force_[k]);
  }

  void apply(std::size_t k, const Vector3d& change) {
    const ConePoint& point = program_.points()[k];
    const auto [a, b] = points_[k].bodies;
    if (a >= 0) velocity_[at(a)].noalias() += point.first.transpose() * change;
    if (b >= 0) velocity_[at(b)].noalias() -= point.second.transpose() * change;
  }

  /// The force that Coulomb's law gives for a force and a velocity a step apart.
  [[nodiscard]] static Vector3d projected(const SweepPoint& p, const ConeStrength& strength,
                                          const Vector3d& force, const Vector3d& velocity) {
    const double opening = velocity[0] - p.dilation * velocity.tail<2>().norm();
    Vector3d next;
    next[0] = std::max(-strength.tension, force[0] - p.normal_step * opening);
    next[0] = std::min(strength.compression, next[0]);
    const double bound = strength.shear_bound(next[0]);
    next.tail<2>() = force.tail<2>() - p.tangent_step * velocity.tail<2>();
    const double shear = next.tail<2>().norm();
    if (shear > bound) next.tail<2>() *= bound / shear;
    return next;
  }

  void update(std::size_t k) {
    const ConePoint& point = program_.points()[k];
    const SweepPoint& p = points_[k];
    Vector3d velocity = Vector3d::Zero();
    if (p.bodies[0] >= 0) velocity.noalias() += point.first * velocity_[at(p.bodies[0])];
    if (p.bodies[1] >= 0) velocity.noalias() -= point.second * velocity_[at(p.bodies[1])];
    fastest_ = std::max(fastest_, velocity.norm());
    Vector3d force = force_[k];
    for (int step = 0; step < local_steps; ++step) {
      const Vector3d next = projected(p, point.strength, force, velocity);
      const Vector3d change = next - force;
      if (change.squaredNorm() == 0.0) break;
      const Vector3d moved = p.compliance * change;
      if (step == 0) lack_ = std::max(lack_, moved.norm());
      velocity += moved;
      force = next;
    }
    const Vector3d change = force - force_[k];
    if (change.squaredNorm() == 0.0) return;
    force_[k] = force;
    apply(k, change);
  }

  const ConeProgram& program_;
  std::vector<SweepPoint> points_;
  std::vector<BodyVelocity> velocity_;
  std::vector<Vector3d> force_;
  double lack_ = 0.0, fastest_ = 0.0;
};

/// The size of motion at checks, each after twice as many sweeps as the one before.
class Decay {
 public:
  void add(double motion) {
    last_change_ = change_;
    change_ = count_ > 0 ? motion_ - motion : 0.0;
    motion_ = motion;
    ++count_;
  }
  /// True if motion persists, extrapolated from its last changes, which decrease by a ratio from check to check.
  [[nodiscard]] bool lasts() const {
    if (count_ < 3) return false;
    return change_ <= no_decay * motion_ || left() > left_over * motion_;
  }
  /// True if the motion vanishes in the limit.
  [[nodiscard]] bool ends() const { return count_ >= 4 && left() < 0.0; }

 private:
  /// Limit of the motion; 0: unknown.
  [[nodiscard]] double left() const {
    const double ratio = last_change_ > 0.0 ? change_ / last_change_ : 0.0;
    return ratio > 0.0 && ratio < slow_ratio ? motion_ - change_ * ratio / (1.0 - ratio) : 0.0;
  }

  double motion_ = 0.0, change_ = 0.0, last_change_ = 0.0;
  int count_ = 0;
};

}  // namespace

double largest_motion(const std::vector<BodyVelocity>& velocity, const std::vector<BodyVelocity>& load,
                      std::size_t bodies) {
  double most = 0.0, largest = 0.0;
  for (const BodyVelocity& own : load) largest = std::max(largest, own.norm());
  if (largest == 0.0) return 0.0;
  for (std::size_t b = 0; b < std::min(bodies, velocity.size()); ++b)
    most = std::max(most, velocity[b].norm() / std::max(load[b].norm(), least_load * largest));
  return most;
}

ReleasedMotion motion_from_rest(const ConeProgram& program, const std::vector<double>& dilation,
                                const std::vector<BodyVelocity>& load, std::vector<Vector3d> force) {
  ReleasedMotion result;
  Sweeps sweeps(program, dilation, load, std::move(force));
  const double points = static_cast<double>(std::max<std::size_t>(program.points().size(), 1));
  const int most =
      static_cast<int>(std::min<double>(most_sweeps, std::max<double>(most_updates / points, first_check)));
  Decay decay;
  int last = most;
  for (int check = first_check; result.iterations < last; check = std::min(2 * check, last)) {
    for (; result.iterations < std::min(check, last); ++result.iterations)
      sweeps.sweep(result.iterations % 2 == 0);
    const double motion = largest_motion(sweeps.velocity(), load, program.loaded_bodies());
    if (motion < resting_motion) {
      result.outcome = LimitOutcome::stands;
      break;
    }
    decay.add(motion);
    const bool done = sweeps.lack() <= exact * sweeps.fastest();
    const bool moves = done || (sweeps.lack() <= coulomb_residual * sweeps.fastest() && decay.lasts());
    // Once motion is certain, a few more sweeps for its accelerations.
    if (moves && result.outcome != LimitOutcome::moves) last = std::min(most, polished * result.iterations);
    result.outcome = moves ? LimitOutcome::moves : LimitOutcome::unknown;
    // Slow decay is treated by slow slip.
    if (done || decay.ends()) break;
  }
  result.velocity = std::move(sweeps.velocity());
  result.force = std::move(sweeps.force());
  return result;
}

}  // namespace ashlar

#include "solver/step/impact.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

constexpr double accuracy = 1e-13;  ///< of the velocities: change in a sweep that ends the iteration

class Impact {
 public:
  Impact(const std::vector<double>& inertia, const std::vector<int>& sizes,
         const std::vector<ImpactPoint>& points)
      : inertia_(inertia), points_(points), impulses_(points.size(), Eigen::Vector3d::Zero()) {
    for (const int size : sizes) changes_.emplace_back(Eigen::VectorXd::Zero(size));
    for (const ImpactPoint& point : points) {
      Eigen::Matrix3d mobility = Eigen::Matrix3d::Zero();
      if (point.a >= 0) mobility += point.of_a * point.of_a.transpose() / inertia[at(point.a)];
      if (point.b >= 0) mobility += point.of_b * point.of_b.transpose() / inertia[at(point.b)];
      mobilities_.push_back(mobility);
      fastest_ = std::max(fastest_, point.velocity.norm());
    }
  }

  /// @return residual
  double solve(int most_sweeps) {
    double most = 0.0;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      most = 0.0;
      for (std::size_t k = 0; k < points_.size(); ++k) most = std::max(most, update(k));
      if (!(most > accuracy * fastest_)) break;
    }
    return fastest_ > 0.0 ? most / fastest_ : 0.0;
  }

  /// Work of the impulses, J: half of them acts on the velocity before, half on that after.
  [[nodiscard]] double work() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < points_.size(); ++k)
      sum += impulses_[k].dot(points_[k].velocity + 0.5 * change_at(k));
    return sum;
  }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& impulses() const { return impulses_; }
  void set_impulses(const std::vector<Eigen::Vector3d>& impulses) {
    for (Eigen::VectorXd& change : changes_) change.setZero();
    impulses_.assign(points_.size(), Eigen::Vector3d::Zero());
    for (std::size_t k = 0; k < points_.size(); ++k) add(k, impulses[k]);
  }
  [[nodiscard]] ImpactResult result(double residual) const { return {changes_, impulses_, work(), residual}; }

 private:
  [[nodiscard]] Eigen::Vector3d change_at(std::size_t k) const {
    const ImpactPoint& point = points_[k];
    Eigen::Vector3d change = Eigen::Vector3d::Zero();
    if (point.a >= 0) change += point.of_a * changes_[at(point.a)];
    if (point.b >= 0) change += point.of_b * changes_[at(point.b)];
    return change;
  }

  void add(std::size_t k, const Eigen::Vector3d& impulse) {
    const ImpactPoint& point = points_[k];
    impulses_[k] += impulse;
    if (point.a >= 0) changes_[at(point.a)] += point.of_a.transpose() * impulse / inertia_[at(point.a)];
    if (point.b >= 0) changes_[at(point.b)] += point.of_b.transpose() * impulse / inertia_[at(point.b)];
  }

  /// Solves the law of one point. @return change of its velocity, m/s
  double update(std::size_t k) {
    const ImpactPoint& point = points_[k];
    const Eigen::Matrix3d& mobility = mobilities_[k];
    if (!(mobility.trace() > 0.0)) return 0.0;
    const Eigen::Vector3d before = impulses_[k];
    if (point.bonded) {
      add(k, -mobility.completeOrthogonalDecomposition().solve(change_at(k)));
    } else {
      update_normal(k);
      update_tangents(k);
    }
    return (mobility * (impulses_[k] - before)).norm();
  }

  void update_normal(std::size_t k) {
    const double mobility = mobilities_[k](0, 0);
    if (!(mobility > 0.0)) return;
    const double short_of = points_[k].target - points_[k].velocity[0] - change_at(k)[0];
    const double impulse = std::max(0.0, impulses_[k][0] + short_of / mobility);
    add(k, {impulse - impulses_[k][0], 0.0, 0.0});
  }

  void update_tangents(std::size_t k) {
    const double mobility = mobilities_[k].bottomRightCorner<2, 2>().trace();
    if (points_[k].friction == 0.0 || !(mobility > 0.0)) return;
    const Eigen::Vector2d before = impulses_[k].tail<2>();
    // The trace is at least the larger eigenvalue: the iteration does not overshoot.
    Eigen::Vector2d impulse = before - (points_[k].velocity + change_at(k)).tail<2>() / mobility;
    const double limit = points_[k].friction * impulses_[k][0];
    if (const double length = impulse.norm(); length > limit) impulse *= limit / length;
    add(k, {0.0, impulse[0] - before[0], impulse[1] - before[1]});
  }

  const std::vector<double>& inertia_;
  const std::vector<ImpactPoint>& points_;
  std::vector<Eigen::Vector3d> impulses_;
  std::vector<Eigen::VectorXd> changes_;
  std::vector<Eigen::Matrix3d> mobilities_;
  double fastest_ = 0.0;
};

/// Impulses between two solutions, as near to the second one as the energy allows.
std::vector<Eigen::Vector3d> between(const std::vector<Eigen::Vector3d>& first,
                                     const std::vector<Eigen::Vector3d>& second, double share) {
  std::vector<Eigen::Vector3d> result;
  for (std::size_t k = 0; k < first.size(); ++k)
    result.emplace_back(first[k] + share * (second[k] - first[k]));
  return result;
}

}  // namespace

ImpactResult solve_impact(const std::vector<double>& inertia, const std::vector<int>& sizes,
                          const std::vector<ImpactPoint>& points, int most_sweeps) {
  Impact impact(inertia, sizes, points);
  double residual = impact.solve(most_sweeps);
  double speed = 0.0, impulse = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    speed = std::max(speed, points[k].velocity.norm());
    impulse += impact.impulses()[k].norm();
  }
  const double rounding = 1e-12 * impulse * speed;
  if (impact.work() <= rounding) return impact.result(residual);
  std::vector<ImpactPoint> plastic = points;
  for (ImpactPoint& point : plastic) point.target = std::min(point.target, 0.0);
  Impact stopped(inertia, sizes, plastic);
  residual = std::max(residual, stopped.solve(most_sweeps));
  const std::vector<Eigen::Vector3d> elastic = impact.impulses();
  double low = 0.0, high = 1.0;
  constexpr int halvings = 60;  // to the last bit
  for (int k = 0; k < halvings; ++k) {
    const double share = 0.5 * (low + high);
    impact.set_impulses(between(stopped.impulses(), elastic, share));
    (impact.work() <= 0.0 ? low : high) = share;
  }
  impact.set_impulses(between(stopped.impulses(), elastic, low));
  return impact.result(residual);
}

}  // namespace ashlar

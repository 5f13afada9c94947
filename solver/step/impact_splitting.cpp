#include "solver/step/impact_splitting.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double over_relaxation = 1.6;
constexpr int iterations_between_checks = 10;
/// Checks between changes of rho, the ratio of changes that makes it change, and its factor.
constexpr int checks_between_changes = 2;
constexpr double unequal = 5.0, factor_of_rho = 2.0;
/// Limits of rho: extreme values follow a ratio that rounding decides.
constexpr double least_rho = 1e-6, most_rho = 1e3;

/// Projection on the impulses that a point can transmit.
Vector3d projected(const ImpactPoint& point, const Vector3d& impulse) {
  if (point.bonded) return impulse;
  const double normal = impulse[0], shear = impulse.tail<2>().norm(), friction = point.friction;
  if (shear <= friction * normal) return impulse;
  if (friction * shear <= -normal) return Vector3d::Zero();
  const double on_cone = (normal + friction * shear) / (1.0 + friction * friction);
  Vector3d result = Vector3d::Zero();
  result[0] = on_cone;
  if (shear > 0.0) result.tail<2>() = friction * on_cone / shear * impulse.tail<2>();
  return result;
}

/// The bodies and points of an impact as one linear system.
class Bodies {
 public:
  Bodies(const std::vector<double>& inertia, const std::vector<int>& sizes,
         const std::vector<ImpactPoint>& points)
      : inertia_(inertia), sizes_(sizes), points_(points), begin_(sizes.size() + 1, 0) {
    std::partial_sum(sizes.begin(), sizes.end(), begin_.begin() + 1);
    for (const ImpactPoint& point : points) {
      double mobility = 0.0;
      for_sides(point, [&](int body, const Matrix3Xd& rows) {
        mobility += rows.squaredNorm() / (3.0 * inertia[at(body)]);
      });
      mobilities_.push_back(mobility);
      fastest_ = std::max(fastest_, point.velocity.norm());
    }
  }

  [[nodiscard]] std::size_t points() const { return points_.size(); }
  [[nodiscard]] const ImpactPoint& point(std::size_t k) const { return points_[k]; }
  /// Mean velocity by impulse of a point alone, 1/kg. 0: both motions are given
  [[nodiscard]] double mobility(std::size_t k) const { return mobilities_[k]; }

  /// Velocity of a point without impulses, from its target.
  [[nodiscard]] Vector3d given(std::size_t k) const {
    const ImpactPoint& point = points_[k];
    if (point.bonded) return Vector3d::Zero();
    return point.velocity - point.target * Vector3d::UnitX();
  }
  [[nodiscard]] Vector3d motion(std::size_t k, const VectorXd& z) const {
    Vector3d sum = Vector3d::Zero();
    for_sides(points_[k], [&](int body, const Matrix3Xd& rows) {
      sum += rows * z.segment(begin_[at(body)], sizes_[at(body)]);
    });
    return sum;
  }
  /// G' f. @param of (point) -> (3), N s
  template <class Of>
  [[nodiscard]] VectorXd on_bodies(const Of& of) const {
    VectorXd sum = VectorXd::Zero(begin_.back());
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Vector3d force = of(k);
      for_sides(points_[k], [&](int body, const Matrix3Xd& rows) {
        sum.segment(begin_[at(body)], sizes_[at(body)]) += rows.transpose() * force;
      });
    }
    return sum;
  }
  /// M^-1 f.
  [[nodiscard]] VectorXd by_inertia(VectorXd force) const {
    for (std::size_t b = 0; b < sizes_.size(); ++b) force.segment(begin_[b], sizes_[b]) /= inertia_[b];
    return force;
  }

  /// M + G' R G. @param stiffness R by point
  [[nodiscard]] Eigen::SparseMatrix<double> system(const std::vector<double>& stiffness) const {
    std::map<std::pair<int, int>, Eigen::MatrixXd> blocks;  // by bodies
    for (std::size_t b = 0; b < sizes_.size(); ++b) {
      const auto body = static_cast<int>(b);
      blocks[{body, body}] = inertia_[b] * Eigen::MatrixXd::Identity(sizes_[b], sizes_[b]);
    }
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (stiffness[k] == 0.0) continue;
      for_sides(points_[k], [&](int row_body, const Matrix3Xd& row) {
        for_sides(points_[k], [&](int column_body, const Matrix3Xd& column) {
          Eigen::MatrixXd& block = blocks[{row_body, column_body}];
          if (block.size() == 0) block.setZero(row.cols(), column.cols());
          block.noalias() += (stiffness[k] * row.transpose()) * column;
        });
      });
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [bodies, block] : blocks)
      for (Eigen::Index j = 0; j < block.cols(); ++j)
        for (Eigen::Index i = 0; i < block.rows(); ++i)
          entries.emplace_back(begin_[at(bodies.first)] + i, begin_[at(bodies.second)] + j, block(i, j));
    Eigen::SparseMatrix<double> matrix(begin_.back(), begin_.back());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  [[nodiscard]] double residual(const std::vector<Vector3d>& impulses) const {
    if (fastest_ == 0.0) return 0.0;
    const VectorXd z = by_inertia(on_bodies([&](std::size_t k) { return impulses[k]; }));
    double largest = 0.0;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (mobilities_[k] == 0.0) continue;
      Vector3d after = given(k) + motion(k, z);
      after[0] += points_[k].friction * after.tail<2>().norm();
      const Vector3d lawful = projected(points_[k], impulses[k] - after / mobilities_[k]);
      largest = std::max(largest, mobilities_[k] * (impulses[k] - lawful).norm());
    }
    return largest / fastest_;
  }

 private:
  template <class Do>
  static void for_sides(const ImpactPoint& point, const Do& act) {
    if (point.a >= 0) act(point.a, point.of_a);
    if (point.b >= 0) act(point.b, point.of_b);
  }

  const std::vector<double>& inertia_;
  const std::vector<int>& sizes_;
  const std::vector<ImpactPoint>& points_;
  std::vector<int> begin_;
  std::vector<double> mobilities_;
  double fastest_ = 0.0;
};

class PointSplitting {
 public:
  explicit PointSplitting(const Bodies& bodies)
      : bodies_(bodies),
        stiffness_(bodies.points(), 0.0),
        impulses_(bodies.points(), Vector3d::Zero()),
        after_(bodies.points(), Vector3d::Zero()) {
    factorize();
  }

  void iterate() {
    const VectorXd z = factor_.solve(bodies_.on_bodies(
        [&](std::size_t k) -> Vector3d { return impulses_[k] + stiffness_[k] * (after_[k] - shifted(k)); }));
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
    factor_.compute(bodies_.system(stiffness_));
  }

  [[nodiscard]] Vector3d shifted(std::size_t k) const {
    return bodies_.given(k) + bodies_.point(k).friction * after_[k].tail<2>().norm() * Vector3d::UnitX();
  }

  /// @param velocity of the point with the bodies, and its shift
  void update(std::size_t k, const Vector3d& velocity) {
    const double stiffness = stiffness_[k];
    const Vector3d relaxed = over_relaxation * velocity + (1.0 - over_relaxation) * after_[k];
    const Vector3d impulse = projected(bodies_.point(k), impulses_[k] - stiffness * relaxed);
    const Vector3d after = relaxed + (impulse - impulses_[k]) / stiffness;
    // Energies, so that points of light and heavy bodies count alike.
    gap_ += (velocity - after).squaredNorm() * stiffness;
    change_ += (after - after_[k]).squaredNorm() * stiffness;
    size_of_impulses_ += impulse.squaredNorm() / stiffness;
    size_of_velocities_ += after.squaredNorm() * stiffness;
    impulses_[k] = impulse;
    after_[k] = after;
  }

  const Bodies& bodies_;
  double rho_ = 1.0;
  std::vector<double> stiffness_;  ///< R by point, kg
  std::vector<Vector3d> impulses_, after_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
  /// Of the last iteration, J: between the velocities of bodies and points, and of the points.
  double gap_ = 0.0, change_ = 0.0;
  double size_of_impulses_ = 0.0, size_of_velocities_ = 0.0;
};

}  // namespace

SplitImpulses split_impulses(const std::vector<double>& inertia, const std::vector<int>& sizes,
                             const std::vector<ImpactPoint>& points, double accuracy, int iterations) {
  const Bodies bodies(inertia, sizes, points);
  PointSplitting splitting(bodies);
  SplitImpulses best{splitting.impulses(), std::numeric_limits<double>::infinity(), 0};
  for (int check = 1; best.iterations < iterations; ++check) {
    for (int k = 0; k < iterations_between_checks; ++k) splitting.iterate();
    best.iterations += iterations_between_checks;
    const double residual = bodies.residual(splitting.impulses());
    if (residual < best.residual) {
      best.residual = residual;
      best.impulses = splitting.impulses();
    }
    if (!(residual > accuracy)) break;
    if (check % checks_between_changes == 0) splitting.adapt();
  }
  return best;
}

double impact_residual(const std::vector<double>& inertia, const std::vector<int>& sizes,
                       const std::vector<ImpactPoint>& points, const std::vector<Vector3d>& impulses) {
  return Bodies(inertia, sizes, points).residual(impulses);
}

}  // namespace ashlar

#include "mechanics/supports/support_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ashlar {
namespace {

/// Largest difference of consistent conditions of supports, relative to the largest displacement.
constexpr double agreement = 1e-9;

/// A of one component, the solution of least squares with it, and which support each row belongs to.
struct Conditions {
  Eigen::MatrixXd matrix;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solution;
  std::vector<std::size_t> support;
};

Conditions conditions_of(const Polyhedron& solid, const PolynomialBasis& basis,
                         const std::vector<BlockSupport>& supports, std::size_t axis) {
  Conditions result;
  result.matrix.resize(0, basis.size());
  for (std::size_t k = 0; k < supports.size(); ++k) {
    const Eigen::MatrixXd rows = support_conditions(solid, basis, supports[k], axis);
    const Eigen::Index above = result.matrix.rows();
    result.matrix.conservativeResize(above + rows.rows(), Eigen::NoChange);
    result.matrix.bottomRows(rows.rows()) = rows;
    result.support.insert(result.support.end(), static_cast<std::size_t>(rows.rows()), k);
  }
  if (result.matrix.rows() == 0) return result;
  result.solution.setThreshold(support_rank_tolerance);
  result.solution.compute(result.matrix);
  return result;
}

/// Times at which piecewise polynomials of degree 3, between the times of all histories and after them, must be equal
/// to be equal everywhere.
std::vector<double> telling_times(const std::vector<RecordedMotion>& motions) {
  std::vector<double> rows;
  for (const RecordedMotion& motion : motions) {
    const std::vector<double> times = motion.times();
    rows.insert(rows.end(), times.begin(), times.end());
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  std::vector<double> times;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double length = k + 1 < rows.size() ? rows[k + 1] - rows[k] : 1.0;
    for (const double share : {0.0, 1.0 / 3.0, 2.0 / 3.0}) times.push_back(rows[k] + share * length);
  }
  return times;
}

/// True if supports that share points have the same displacement at all times.
/// @param unmet (#conditions, #motions) residual of each condition for a unit displacement
bool agree(const Eigen::MatrixXd& unmet, const std::vector<RecordedMotion>& motions, Eigen::Index component) {
  if (!(unmet.cwiseAbs().maxCoeff() > agreement)) return true;
  const std::vector<double> times = telling_times(motions);
  double most_unmet = 0.0, farthest = 0.0;
  for (const double time : times) {
    Eigen::VectorXd displacements(unmet.cols());
    for (Eigen::Index n = 0; n < displacements.size(); ++n)
      displacements[n] = motions[static_cast<std::size_t>(n)].displacement(time)[component];
    farthest = std::max(farthest, displacements.cwiseAbs().maxCoeff());
    most_unmet = std::max(most_unmet, (unmet * displacements).cwiseAbs().maxCoeff());
  }
  return most_unmet <= agreement * farthest;
}

}  // namespace

SupportMotion::SupportMotion(const Polyhedron& solid, const PolynomialBasis& basis,
                             const std::vector<BlockSupport>& supports) {
  constexpr std::size_t at_rest = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> group(supports.size(), at_rest);
  for (std::size_t k = 0; k < supports.size(); ++k) {
    const BlockSupport& support = supports[k];
    if (support.history.times.empty()) continue;
    group[k] = 0;
    while (group[k] < driven_.size() && !(driven_[group[k]].history == support.history)) ++group[k];
    if (group[k] == driven_.size())
      driven_.push_back(
          {support.history, RecordedMotion(support.history), Eigen::MatrixX3d::Zero(basis.size(), 3)});
    const Vector3 start = driven_[group[k]].motion.displacement(0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (support.components[axis] && start[static_cast<Eigen::Index>(axis)] != 0.0)
        throw std::invalid_argument("the history of a support is not zero at time 0, where it was placed");
    }
  }
  if (!moves()) return;

  std::vector<RecordedMotion> motions;
  for (const Driven& driven : driven_) motions.push_back(driven.motion);
  const double scale = std::sqrt(basis.volume());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto component = static_cast<Eigen::Index>(axis);
    const Conditions conditions = conditions_of(solid, basis, supports, axis);
    if (conditions.matrix.rows() == 0) continue;
    // Residual of each row for a unit displacement of each group.
    Eigen::MatrixXd unmet(conditions.matrix.rows(), static_cast<Eigen::Index>(driven_.size()));
    for (std::size_t n = 0; n < driven_.size(); ++n) {
      Eigen::VectorXd target(conditions.matrix.rows());
      for (Eigen::Index row = 0; row < target.size(); ++row)
        target[row] = group[conditions.support[static_cast<std::size_t>(row)]] == n ? scale : 0.0;
      driven_[n].field.col(component) = conditions.solution.solve(target);
      unmet.col(static_cast<Eigen::Index>(n)) =
          (conditions.matrix * driven_[n].field.col(component) - target) / scale;
    }
    if (!agree(unmet, motions, component))
      throw std::invalid_argument(
          "supports that share points move them to different places, the same history is needed where they "
          "meet");
  }
}

bool SupportMotion::has_velocity() const {
  return std::any_of(driven_.begin(), driven_.end(), [](const Driven& d) { return d.motion.smooth(); });
}

Eigen::MatrixX3d SupportMotion::at(double time) const {
  Eigen::MatrixX3d sum = Eigen::MatrixX3d::Zero(driven_.front().field.rows(), 3);
  for (const Driven& driven : driven_) sum += driven.field * driven.motion.displacement(time).asDiagonal();
  return sum;
}

Eigen::MatrixX3d SupportMotion::velocity(double from, double step) const {
  Eigen::MatrixX3d sum = Eigen::MatrixX3d::Zero(driven_.front().field.rows(), 3);
  for (const auto& [history, motion, field] : driven_) {
    const Vector3 velocity =
        motion.smooth() ? motion.velocity(from + step)
                        : Vector3((motion.displacement(from + step) - motion.displacement(from)) / step);
    sum += field * velocity.asDiagonal();
  }
  return sum;
}

bool SupportMotion::changes_between(double start, double end) const {
  return std::any_of(driven_.begin(), driven_.end(),
                     [&](const Driven& driven) { return driven.motion.changes_between(start, end); });
}

}  // namespace ashlar

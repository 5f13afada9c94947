#include "mechanics/support_motion.hpp"

#include <algorithm>
#include <stdexcept>

namespace ashlar {
namespace {

/// What conditions of supports that agree with each other may differ by, as a share of the largest
/// displacement.
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

}  // namespace

double displacement_at(const SupportHistory& history, std::size_t axis, double time) {
  const auto next = std::upper_bound(history.times.begin(), history.times.end(), time);
  const auto k = static_cast<std::size_t>(next - history.times.begin());
  const auto value = [&](std::size_t n) { return history.displacements[n][static_cast<Eigen::Index>(axis)]; };
  if (k == 0) return value(0);
  if (k == history.times.size()) return value(k - 1);
  const double share = (time - history.times[k - 1]) / (history.times[k] - history.times[k - 1]);
  return value(k - 1) + share * (value(k) - value(k - 1));
}

SupportMotion::SupportMotion(const Polyhedron& solid, const PolynomialBasis& basis,
                             const std::vector<BlockSupport>& supports) {
  double largest = 0.0;
  for (const BlockSupport& support : supports) {
    const SupportHistory& history = support.history;
    times_.insert(times_.end(), history.times.begin(), history.times.end());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (history.times.empty() || !support.components[axis]) continue;
      if (displacement_at(history, axis, 0.0) != 0.0)
        throw std::invalid_argument(
            "the displacement_history of a support is not zero at time 0, where it was placed");
    }
    for (const Vector3& displacement : history.displacements)
      largest = std::max(largest, displacement.cwiseAbs().maxCoeff());
  }
  std::sort(times_.begin(), times_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
  if (!moves()) return;

  coefficients_.assign(times_.size(), Eigen::MatrixX3d::Zero(basis.size(), 3));
  const double scale = std::sqrt(basis.volume());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Conditions conditions = conditions_of(solid, basis, supports, axis);
    if (conditions.matrix.rows() == 0) continue;
    for (std::size_t n = 0; n < times_.size(); ++n) {
      Eigen::VectorXd target(conditions.matrix.rows());
      for (Eigen::Index row = 0; row < target.size(); ++row) {
        const SupportHistory& history = supports[conditions.support[static_cast<std::size_t>(row)]].history;
        target[row] = history.times.empty() ? 0.0 : scale * displacement_at(history, axis, times_[n]);
      }
      const Eigen::VectorXd c = conditions.solution.solve(target);
      if ((conditions.matrix * c - target).cwiseAbs().maxCoeff() > agreement * scale * largest)
        throw std::invalid_argument(
            "supports that share points move them to different places, the same history is needed where they "
            "meet");
      coefficients_[n].col(static_cast<Eigen::Index>(axis)) = c;
    }
  }
}

Eigen::MatrixX3d SupportMotion::at(double time) const {
  const auto next = std::upper_bound(times_.begin(), times_.end(), time);
  const auto k = static_cast<std::size_t>(next - times_.begin());
  if (k == 0) return coefficients_.front();
  if (k == times_.size()) return coefficients_.back();
  const double share = (time - times_[k - 1]) / (times_[k] - times_[k - 1]);
  return coefficients_[k - 1] + share * (coefficients_[k] - coefficients_[k - 1]);
}

bool SupportMotion::changes_between(double start, double end) const {
  for (std::size_t k = 0; k + 1 < times_.size(); ++k) {
    if (times_[k] < end && times_[k + 1] > start && coefficients_[k] != coefficients_[k + 1]) return true;
  }
  return false;
}

}  // namespace ashlar

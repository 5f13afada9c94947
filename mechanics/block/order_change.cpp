#include "mechanics/block/order_change.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ashlar {
namespace {

/// Coefficients with the number of rows of the other order.
Eigen::MatrixX3d resized(const Eigen::MatrixX3d& coefficients, Eigen::Index rows) {
  Eigen::MatrixX3d result = Eigen::MatrixX3d::Zero(rows, 3);
  const Eigen::Index kept = std::min(rows, coefficients.rows());
  result.topRows(kept) = coefficients.topRows(kept);
  return result;
}

/// The basis is orthonormal: a norm of coefficients is the root of an integral of squares.
double difference(const Eigen::MatrixX3d& before, const Eigen::MatrixX3d& after, double volume) {
  const Eigen::Index rows = std::max(before.rows(), after.rows());
  return (resized(before, rows) - resized(after, rows)).norm() / std::sqrt(volume);
}

}  // namespace

OrderChange change_order(const BlockModel& from, const BlockState& state, const BlockModel& to) {
  if (from.fixed() || to.fixed() || &from.solid() != &to.solid())
    throw std::invalid_argument("an order is changed between models of one moving block");
  const double volume = from.basis().volume();
  const Eigen::MatrixX3d displacement = state.position - from.basis().identity_map();
  const auto held = [&](const Eigen::MatrixX3d& field) {
    return Eigen::MatrixX3d(to.space().expand(to.space().restrict(resized(field, to.basis().size()))));
  };
  const Eigen::MatrixX3d kept_displacement = held(displacement);
  const Eigen::MatrixX3d kept_velocity = held(state.velocity);
  return {{to.basis().identity_map() + kept_displacement, kept_velocity},
          difference(displacement, kept_displacement, volume),
          difference(state.velocity, kept_velocity, volume)};
}

}  // namespace ashlar

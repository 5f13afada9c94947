#include "solver/step/accept/angular_momentum.hpp"

#include <Eigen/QR>
#include <cmath>

#include "geometry/index.hpp"
#include "mechanics/basis/field_moments.hpp"

namespace ashlar {
namespace {

/// Coefficients of the position of a block relative to a point.
Eigen::MatrixX3d arms_of(const BlockModel& block, const BlockState& state, const Vector3& point) {
  return from_point(state.position, block.basis().volume(), point);
}

}  // namespace

Vector3 stray_angular_momentum(const BlockModel& block, const BlockState& before, const BlockState& after,
                               const Eigen::MatrixX3d& known, double step, const Vector3& origin) {
  const double density = block.material().density;
  const Eigen::MatrixX3d place =
      from_point(0.5 * (before.position + after.position), block.basis().volume(), origin);
  const Eigen::MatrixX3d velocity = 0.5 * (before.velocity + after.velocity);
  const Eigen::MatrixX3d uneven = after.position - before.position - step * velocity;
  const Eigen::MatrixX3d unknown = density * (after.velocity - before.velocity) - step * known;
  return integral_of_cross(place, unknown) + density * integral_of_cross(uneven, velocity);
}

Vector3 centroid_of(const std::vector<BlockModel>& blocks, const std::vector<int>& body,
                    const std::vector<BlockState>& states) {
  double mass = 0.0;
  Vector3 sum = Vector3::Zero();
  for (const int k : body) {
    mass += blocks[at(k)].mass();
    sum += blocks[at(k)].mass() * mean_of(states[at(k)].position, blocks[at(k)].basis().volume());
  }
  return sum / mass;
}

Vector3 angular_momentum_of(const std::vector<BlockModel>& blocks, const std::vector<int>& body,
                            const std::vector<BlockState>& states) {
  Vector3 sum = Vector3::Zero();
  for (const int k : body) sum += blocks[at(k)].angular_momentum(states[at(k)]);
  return sum;
}

double Spin::share_within(double limit) const {
  if (!(linear + square > limit)) return 1.0;
  const double root = std::sqrt(linear * linear + 4.0 * square * limit);
  return linear > 0.0 ? 2.0 * limit / (linear + root) : (root - linear) / (2.0 * square);
}

void Spin::add(double share, const std::vector<BlockModel>& blocks, const std::vector<int>& body,
               std::vector<BlockState>& states) const {
  for (const int k : body)
    states[at(k)].velocity += turning_field(share * angular, arms_of(blocks[at(k)], states[at(k)], centroid));
}

std::vector<Spin> spins_of(const std::vector<BlockModel>& blocks, const std::vector<std::vector<int>>& bodies,
                           const std::vector<Vector3>& angular_momenta, const std::vector<BlockState>& states,
                           const SumOverProcesses& sum) {
  const auto count = static_cast<Eigen::Index>(bodies.size());
  std::vector<Spin> spins(bodies.size());
  const auto each = [&](const auto& act) {
    for (std::size_t n = 0; n < bodies.size(); ++n)
      for (const int k : bodies[n]) act(n, static_cast<Eigen::Index>(n), k);
  };
  const auto sum_up = [&sum](Eigen::MatrixXd& values) {
    if (sum) sum(values);
  };
  Eigen::MatrixXd masses = Eigen::MatrixXd::Zero(4, count);  // mass and its moment
  each([&](std::size_t, Eigen::Index column, int k) {
    const double mass = blocks[at(k)].mass();
    masses(0, column) += mass;
    masses.col(column).tail<3>() += mass * mean_of(states[at(k)].position, blocks[at(k)].basis().volume());
  });
  sum_up(masses);
  for (Eigen::Index n = 0; n < count; ++n)
    spins[static_cast<std::size_t>(n)].centroid = masses.col(n).tail<3>() / masses(0, n);
  Eigen::MatrixXd inertias = Eigen::MatrixXd::Zero(9, count);
  each([&](std::size_t n, Eigen::Index column, int k) {
    const Eigen::Matrix3d inertia = blocks[at(k)].material().density *
                                    unit_inertia(arms_of(blocks[at(k)], states[at(k)], spins[n].centroid));
    inertias.col(column) += inertia.reshaped();
  });
  sum_up(inertias);
  for (std::size_t n = 0; n < spins.size(); ++n) {
    const Eigen::Matrix3d inertia = inertias.col(static_cast<Eigen::Index>(n)).reshaped(3, 3);
    // A moment lost in the rounding of the largest one, as that of a needle about its axis, gives no spin.
    spins[n].angular = inertia.completeOrthogonalDecomposition().solve(angular_momenta[n]);
    spins[n].square = 0.5 * spins[n].angular.dot(angular_momenta[n]);
  }
  Eigen::MatrixXd linear = Eigen::MatrixXd::Zero(1, count);
  each([&](std::size_t n, Eigen::Index column, int k) {
    linear(0, column) +=
        blocks[at(k)].material().density *
        spins[n].angular.dot(integral_of_cross(arms_of(blocks[at(k)], states[at(k)], spins[n].centroid),
                                               states[at(k)].velocity));
  });
  sum_up(linear);
  for (std::size_t n = 0; n < spins.size(); ++n) spins[n].linear = linear(0, static_cast<Eigen::Index>(n));
  return spins;
}

double add_spin(const std::vector<BlockModel>& blocks, const std::vector<int>& body,
                const Vector3& angular_momentum, double limit, std::vector<BlockState>& states) {
  const Spin spin = spins_of(blocks, {body}, {angular_momentum}, states).front();
  const double share = spin.share_within(limit);
  spin.add(share, blocks, body, states);
  return spin.gain(share);
}

}  // namespace ashlar

#include "solver/step/angular_momentum.hpp"

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

double add_spin(const std::vector<BlockModel>& blocks, const std::vector<int>& body,
                const Vector3& angular_momentum, double limit, std::vector<BlockState>& states) {
  const Vector3 centroid = centroid_of(blocks, body, states);
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const int k : body) {
    inertia +=
        blocks[at(k)].material().density * unit_inertia(arms_of(blocks[at(k)], states[at(k)], centroid));
  }
  // A moment lost in the rounding of the largest one, as that of a needle about its axis, gives no spin.
  const Vector3 spin = inertia.completeOrthogonalDecomposition().solve(angular_momentum);
  // The gain of kinetic energy is  linear s + square s^2  with the share s of the spin.
  double linear = 0.0;
  const double square = 0.5 * spin.dot(angular_momentum);
  for (const int k : body)
    linear +=
        blocks[at(k)].material().density *
        spin.dot(integral_of_cross(arms_of(blocks[at(k)], states[at(k)], centroid), states[at(k)].velocity));
  double share = 1.0;
  if (linear + square > limit) {
    const double root = std::sqrt(linear * linear + 4.0 * square * limit);
    share = linear > 0.0 ? 2.0 * limit / (linear + root) : (root - linear) / (2.0 * square);
  }
  for (const int k : body)
    states[at(k)].velocity += turning_field(share * spin, arms_of(blocks[at(k)], states[at(k)], centroid));
  return share * (linear + share * square);
}

}  // namespace ashlar

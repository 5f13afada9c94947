#include "solver/angular_momentum.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace ashlar {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Sum of a_k x b_k from a row on.
Vector3 sum_of_crosses(const Eigen::MatrixX3d& a, const Eigen::MatrixX3d& b, Eigen::Index first) {
  Vector3 sum = Vector3::Zero();
  for (Eigen::Index k = first; k < a.rows(); ++k) {
    const Vector3 left = a.row(k);
    const Vector3 right = b.row(k);
    sum += left.cross(right);
  }
  return sum;
}

/// Coefficients of the position of a block from a point on. The first function is constant.
Eigen::MatrixX3d from_point(const BlockModel& block, const BlockState& state, const Vector3& point) {
  Eigen::MatrixX3d places = state.position;
  places.row(0) -= std::sqrt(block.basis().volume()) * point.transpose();
  return places;
}

}  // namespace

std::vector<std::vector<int>> free_bodies(const std::vector<BlockModel>& blocks,
                                          const std::vector<std::array<int, 2>>& ties) {
  std::vector<int> first(blocks.size());  // of the set a block is in
  std::iota(first.begin(), first.end(), 0);
  const auto find = [&](int block) {
    while (first[at(block)] != block) block = first[at(block)];
    return block;
  };
  for (const auto& [a, b] : ties) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    first[at(high)] = low;
  }
  std::vector<std::vector<int>> sets(blocks.size());
  std::vector<bool> free(blocks.size(), true);
  for (int k = 0; k < static_cast<int>(blocks.size()); ++k) {
    const BlockModel& block = blocks[at(k)];
    const int set = find(k);
    sets[at(set)].push_back(k);
    if (block.fixed() || block.supported() || block.incremental() != nullptr) free[at(set)] = false;
  }
  std::vector<std::vector<int>> result;
  for (std::size_t set = 0; set < sets.size(); ++set)
    if (free[set] && !sets[set].empty()) result.push_back(std::move(sets[set]));
  return result;
}

Vector3 stray_angular_momentum(const BlockModel& block, const BlockState& before, const BlockState& after,
                               const Eigen::MatrixX3d& known, double step) {
  const double density = block.material().density;
  const Eigen::MatrixX3d place = 0.5 * (before.position + after.position);
  const Eigen::MatrixX3d velocity = 0.5 * (before.velocity + after.velocity);
  const Eigen::MatrixX3d uneven = after.position - before.position - step * velocity;
  const Eigen::MatrixX3d unknown = density * (after.velocity - before.velocity) - step * known;
  // Internal forces have no resultant: the constant function would only bring in its rounding.
  return sum_of_crosses(place, unknown, 1) + density * sum_of_crosses(uneven, velocity, 0);
}

double add_spin(const std::vector<BlockModel>& blocks, const std::vector<int>& body,
                const Vector3& angular_momentum, double limit, std::vector<BlockState>& states) {
  double mass = 0.0;
  Vector3 centroid = Vector3::Zero();
  for (const int k : body) {
    mass += blocks[at(k)].mass();
    centroid += blocks[at(k)].mass() / std::sqrt(blocks[at(k)].basis().volume()) *
                states[at(k)].position.row(0).transpose();
  }
  centroid /= mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const int k : body) {
    const Eigen::MatrixX3d arms = from_point(blocks[at(k)], states[at(k)], centroid);
    const Eigen::Matrix3d products = arms.transpose() * arms;
    inertia += blocks[at(k)].material().density * (products.trace() * Eigen::Matrix3d::Identity() - products);
  }
  const Vector3 spin = inertia.llt().solve(angular_momentum);
  // The kinetic energy is gained as  linear s + square s^2  with the share s of the spin.
  double linear = 0.0;
  const double square = 0.5 * spin.dot(angular_momentum);
  for (const int k : body)
    linear += blocks[at(k)].material().density *
              spin.dot(sum_of_crosses(from_point(blocks[at(k)], states[at(k)], centroid),
                                      states[at(k)].velocity, 0));
  double share = 1.0;
  if (linear + square > limit) {
    const double root = std::sqrt(linear * linear + 4.0 * square * limit);
    share = linear > 0.0 ? 2.0 * limit / (linear + root) : (root - linear) / (2.0 * square);
  }
  for (const int k : body) {
    const Eigen::MatrixX3d arms = from_point(blocks[at(k)], states[at(k)], centroid);
    for (Eigen::Index row = 0; row < arms.rows(); ++row)
      states[at(k)].velocity.row(row) += share * spin.cross(Vector3(arms.row(row))).transpose();
  }
  return share * (linear + share * square);
}

}  // namespace ashlar

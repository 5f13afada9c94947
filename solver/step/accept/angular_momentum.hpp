// Angular momentum of free blocks (theory.md section 9: it changes by external forces only).
//
// Internal forces have no moment about the configuration they are evaluated at. A step of length dt applies them over
// the displacement D = x' - x. With the means xm = (x + x')/2 and vm = (v + v')/2
//
//   L' - L = sum_k xm_k x rho (v'_k - v_k) + rho sum_k (D_k - dt vm_k) x vm_k
//
// over the coefficients k of a block. Forces evaluated at the end of the step have a moment about xm, which removes
// the share (w dt)^2 / 2 of the spin of a block that rotates at w, in every step. The second sum is not zero where
// contact forces do not act evenly over the step. Contacts and ties of free blocks are balanced about xm
// (contact_pair.hpp). The rest is returned as a rigid spin, which causes no strain and is of the order of (w dt)^2.
// With dda the spin gains no more energy than the step has dissipated in the body, so that the step stays stable for
// any angle of rotation; the two differ by a higher power of w dt. average-acceleration evaluates internal forces at
// xm, which leaves no error.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Change of the angular momentum of blocks of a free body that is not caused by known forces, kg m^2/s. Meaningful
/// as a sum over the body, as the force that balances a tie on one block may act on another one. Exact but for
/// rounding.
/// @param known contacts, ties, gravity, loads and damping as they act in the step, (p, 3), N m^-3/2
/// @param origin of the moments, m: the same for all blocks of a body, near it
[[nodiscard]] Vector3 stray_angular_momentum(const BlockModel& block, const BlockState& before,
                                             const BlockState& after, const Eigen::MatrixX3d& known,
                                             double step, const Vector3& origin);

/// Centroid of a body, m. @param body indices
[[nodiscard]] Vector3 centroid_of(const std::vector<BlockModel>& blocks, const std::vector<int>& body,
                                  const std::vector<BlockState>& states);

/// Angular momentum of a body about the origin, kg m^2/s. @param body indices
[[nodiscard]] Vector3 angular_momentum_of(const std::vector<BlockModel>& blocks, const std::vector<int>& body,
                                          const std::vector<BlockState>& states);

/// A rigid rotation of a body about its centroid. A share s of it adds  linear s + square s^2  to the kinetic energy.
struct Spin {
  Vector3 centroid = Vector3::Zero();  ///< m
  Vector3 angular = Vector3::Zero();   ///< rad/s
  double linear = 0.0;                 ///< J
  double square = 0.0;                 ///< J, >= 0

  [[nodiscard]] double gain(double share) const { return share * (linear + share * square); }
  /// Largest share that gains at most this energy, <= 1. @param limit J, >= 0
  [[nodiscard]] double share_within(double limit) const;
  /// Adds a share to the velocities of blocks of the body. @param body indices
  void add(double share, const std::vector<BlockModel>& blocks, const std::vector<int>& body,
           std::vector<BlockState>& states) const;
};

/// Sums values over processes, in place. @param values a column for each body
using SumOverProcesses = std::function<void(Eigen::MatrixXd& values)>;

/// Spins that give bodies an angular momentum. @param bodies indices of the blocks of each; on a process its own blocks
/// @param angular_momenta gained by each, kg m^2/s. @param sum empty: bodies are whole here
[[nodiscard]] std::vector<Spin> spins_of(const std::vector<BlockModel>& blocks,
                                         const std::vector<std::vector<int>>& bodies,
                                         const std::vector<Vector3>& angular_momenta,
                                         const std::vector<BlockState>& states,
                                         const SumOverProcesses& sum = {});

/// Adds a rigid rotation about the common centroid of blocks to their velocities, scaled down if it would exceed a
/// limit of energy. @param body indices. @param angular_momentum gained, kg m^2/s
/// @param limit of the gain of kinetic energy, J, >= 0. @return gain of kinetic energy, J
double add_spin(const std::vector<BlockModel>& blocks, const std::vector<int>& body,
                const Vector3& angular_momentum, double limit, std::vector<BlockState>& states);

}  // namespace ashlar

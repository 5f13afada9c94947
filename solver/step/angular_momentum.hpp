// Angular momentum of free blocks (theory.md section 9: it changes by external forces only).
//
// Internal forces have no moment about the place they are evaluated at. A step of length dt applies them over
// the way from x to x', D = x' - x, and with means xm = (x + x')/2, vm = (v + v')/2
//
//   L' - L = sum_k xm_k x rho (v'_k - v_k) + rho sum_k (D_k - dt vm_k) x vm_k
//
// over the coefficients k of a block. Forces evaluated at the end have a moment about xm, which takes
// (w dt)^2 / 2 of its spin from a block that turns at w, in every step; and where contact forces do not act
// evenly over the step, the second sum is not zero. Contacts and ties of free blocks are balanced about xm
// (contact_pair.hpp). What is left is given back as a rigid spin, which strains nothing and is of the order
// of (w dt)^2. With dda it takes up no more energy than the step has dissipated in the body, so that this
// step stays stable whatever a block turns by; the two differ by a higher power of w dt. average-acceleration
// takes internal forces at xm: nothing is left there.
#pragma once

#include <array>
#include <vector>

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Angular momentum that a step gave to blocks of a free body beside what known forces did, kg m^2/s: the sum
/// over the body, as what balances a tie's forces on one block need not be on that block, but for rounding.
/// @param known contacts, ties, gravity, loads and damping as they act in the step, (p, 3), N m^-3/2
/// @param origin about which, m: the same for all blocks of a body, near it
[[nodiscard]] Vector3 stray_angular_momentum(const BlockModel& block, const BlockState& before,
                                             const BlockState& after, const Eigen::MatrixX3d& known,
                                             double step, const Vector3& origin);

/// Centroid of a body, m. @param body indices
[[nodiscard]] Vector3 centroid_of(const std::vector<BlockModel>& blocks, const std::vector<int>& body,
                                  const std::vector<BlockState>& states);

/// Of a body about the origin, kg m^2/s. @param body indices
[[nodiscard]] Vector3 angular_momentum_of(const std::vector<BlockModel>& blocks, const std::vector<int>& body,
                                          const std::vector<BlockState>& states);

/// Adds to the velocities of blocks those of a rigid turn about their common centroid, or as much of them as
/// does not exceed a limit of energy. @param body indices. @param angular_momentum that they gain, kg m^2/s
/// @param limit of what they gain of kinetic energy, J, >= 0. @return what they gain of it, J
double add_spin(const std::vector<BlockModel>& blocks, const std::vector<int>& body,
                const Vector3& angular_momentum, double limit, std::vector<BlockState>& states);

}  // namespace ashlar

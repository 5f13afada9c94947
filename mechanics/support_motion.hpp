// Supports that move: the part of a block's motion that their histories prescribe.
//
// With the conditions  A q_k = b_k(t)  of all supports on component k, the coefficients of a supported block
// are
//     q(t) = q0 + Z y + c(t),   c = A^+ b,   Z' c = 0:
// the unknowns y stay those of supports at rest (supports.hpp), c is the smallest field that follows the
// supports and, as mass is rho I, has no inertia in common with y. c is linear in time where all histories
// are.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "mechanics/supports.hpp"

namespace ashlar {

/// Displacement of a support along an axis, m: linear between the times of its history, constant before and
/// after. @param history not empty
[[nodiscard]] double displacement_at(const SupportHistory& history, std::size_t axis, double time);

/// c(t) of one block.
class SupportMotion {
 public:
  /// No support moves.
  SupportMotion() = default;
  /// @throws std::invalid_argument if supports that share points of the block want them in different places,
  /// or a support is not where it was placed at time 0
  SupportMotion(const Polyhedron& solid, const PolynomialBasis& basis,
                const std::vector<BlockSupport>& supports);

  /// True if some support ever moves.
  [[nodiscard]] bool moves() const { return !times_.empty(); }
  /// c at a time. @return (p, 3); only if something moves
  [[nodiscard]] Eigen::MatrixX3d at(double time) const;
  /// Whether c may differ between two times.
  [[nodiscard]] bool changes_between(double start, double end) const;

 private:
  std::vector<double> times_;                   ///< s, increasing: all times of all histories
  std::vector<Eigen::MatrixX3d> coefficients_;  ///< c at these times
};

}  // namespace ashlar

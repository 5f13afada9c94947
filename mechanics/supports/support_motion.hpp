// Moving supports: the part of a block's motion prescribed by their histories.
//
// With the conditions  A q_k = b_k(t)  of all supports on component k, the coefficients of a supported block
// are
//     q(t) = q0 + Z y + c(t),   c = A^+ b,   Z' c = 0:
// The unknowns y stay those of supports at rest (supports.hpp). c is the smallest field that follows the supports
// and, as mass is rho I, is not coupled to y by inertia. Supports that share a history share a displacement u(t), and
// c(t) = sum of their fields F times u(t):  F = A^+ of a unit displacement.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "mechanics/supports/supports.hpp"

namespace ashlar {

/// c(t) of one block.
class SupportMotion {
 public:
  /// No support moves.
  SupportMotion() = default;
  /// @throws std::invalid_argument if supports that share points of the block prescribe different displacements, or a
  /// support has a displacement at time 0; std::domain_error as RecordedMotion does
  SupportMotion(const Polyhedron& solid, const PolynomialBasis& basis,
                const std::vector<BlockSupport>& supports);

  /// True if any support moves at any time.
  [[nodiscard]] bool moves() const { return !driven_.empty(); }
  /// True if any support has a velocity at each time (RecordedMotion::smooth).
  [[nodiscard]] bool has_velocity() const;
  /// c at a time. @return (p, 3); only if any support moves
  [[nodiscard]] Eigen::MatrixX3d at(double time) const;
  /// dc/dt at the end of a step; for supports without a velocity the mean in the step.
  /// @param step s, > 0. @return (p, 3); only if any support moves
  [[nodiscard]] Eigen::MatrixX3d velocity(double from, double step) const;
  /// True if c may differ between two times.
  [[nodiscard]] bool changes_between(double start, double end) const;

 private:
  /// Supports of one history.
  struct Driven {
    SupportHistory history;
    RecordedMotion motion;
    Eigen::MatrixX3d field;  ///< F, (p, 3): column k follows component k of the displacement
  };
  std::vector<Driven> driven_;
};

}  // namespace ashlar

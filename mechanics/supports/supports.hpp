// Clamped faces and points, met exactly: the coefficients of a supported block are q = q0 + Z y with the
// columns of Z an orthonormal basis of all motions that vanish on the supports (theory.md section 2). A
// supported block has fewer unknowns, not stiffer ones, and its mass matrix stays rho I.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "mechanics/basis/basis.hpp"
#include "mechanics/supports/face_selection.hpp"
#include "mechanics/supports/recorded_motion.hpp"

namespace ashlar {

/// A support of faces or of one material point; selected components of its displacement are zero or follow a history.
struct BlockSupport {
  BlockPlace where;  ///< reference coordinates, m
  std::array<bool, 3> components = {true, true, true};
  SupportHistory history = {};  ///< of the selected components; empty: at rest
};

/// Singular values below this part of the largest belong to redundant conditions.
inline constexpr double support_rank_tolerance = 1e-10;

/// Rows for one component of the displacement on a support, scaled to comparable sizes: basis values times
/// sqrt(volume). Coefficients in their null space vanish on the support. @return (#conditions, p), none if the
/// component is free.
/// @throws std::invalid_argument if a plane holds no face of the solid
[[nodiscard]] Eigen::MatrixXd support_conditions(const Polyhedron& solid, const PolynomialBasis& basis,
                                                 const BlockSupport& support, std::size_t axis);

/// Admissible motions of one block. A free block stores no matrices.
class AdmissibleSpace {
 public:
  /// No supports. @param functions p
  explicit AdmissibleSpace(int functions) : functions_(functions) {}

  /// @throws std::invalid_argument if a plane holds no face of the solid
  AdmissibleSpace(const Polyhedron& solid, const PolynomialBasis& basis,
                  const std::vector<BlockSupport>& supports);

  /// Number of unknowns, the columns of Z.
  [[nodiscard]] int unknowns() const;
  /// True if nothing is supported: Z = I.
  [[nodiscard]] bool free() const { return free_; }
  /// True if no support holds this component of the displacement anywhere. @param axis 0 to 2
  [[nodiscard]] bool free_along(int axis) const {
    return columns(static_cast<std::size_t>(axis)) == functions_;
  }
  /// True if no rigid motion is admissible: the block can rest under any load.
  [[nodiscard]] bool held() const { return held_; }
  /// True if any admissible rigid motion includes rotation; otherwise small-displacement theory applies.
  [[nodiscard]] bool can_turn() const { return can_turn_; }

  /// Z y. @param y (unknowns). @return (p, 3)
  [[nodiscard]] Eigen::MatrixX3d expand(const Eigen::VectorXd& y) const;
  /// Z' f. @param f (p, 3). @return (unknowns)
  [[nodiscard]] Eigen::VectorXd restrict(const Eigen::MatrixX3d& f) const;
  /// Z' K Z. @param matrix (3p, 3p). @return (unknowns, unknowns)
  [[nodiscard]] Eigen::MatrixXd restrict(const Eigen::MatrixXd& matrix) const;
  /// Values at some points that give one component of the displacement from the unknowns of that component. Unknowns
  /// are ordered x, then y, then z. @param phi (m, p) basis values. @return (m, unknowns of the component)
  [[nodiscard]] Eigen::MatrixXd component_values(const Eigen::MatrixXd& phi, int axis) const;

 private:
  [[nodiscard]] Eigen::Index columns(std::size_t axis) const {
    return free_ ? functions_ : null_space_[axis].cols();
  }

  int functions_;
  bool free_ = true;
  bool held_ = false;
  bool can_turn_ = true;
  std::array<Eigen::MatrixXd, 3> null_space_;  ///< Z of each component, (p, columns); empty when free
};

}  // namespace ashlar

// Motion of contact points with the unknowns of one block. A row of a point is a direction times the values of the
// block's functions there. Values are stored instead of rows: nine times fewer numbers, and
//
//   motion   u_i(k) = sum_f Phi_i(k, f) y_i(f)                 i: x, y, z
//   force    F_i(f) = sum_k Phi_i(k, f) f_i(k)
//   tangent  T_ij = Phi_i' diag(t_ij) Phi_j                     t(k): stiffness of a point along x, y, z
//
// with Phi_i (points, unknowns along axis i): values times the null space of the supports of that component, the
// same for all three where the block is free.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "mechanics/supports/supports.hpp"

namespace ashlar {

/// Stiffnesses of points along x, y, z: t(k), 3 x 3, column major, symmetric. (9, #points), N/m
using PointStiffnesses = Eigen::Matrix<double, 9, Eigen::Dynamic>;

/// Rows of one block. Without unknowns (fixed block) all operations have no effect.
class BlockRows {
 public:
  BlockRows() = default;
  /// @param phi (#points, p) values of the block's functions
  BlockRows(const AdmissibleSpace& space, const Eigen::MatrixXd& phi);

  [[nodiscard]] bool fixed() const { return starts_[3] == 0; }
  [[nodiscard]] Eigen::Index unknowns() const { return starts_[3]; }

  /// Adds `sign` times the motion of all points. @param y (unknowns). @param motion (3, #points)
  void add_motion(const Eigen::VectorXd& y, double sign, Eigen::Matrix3Xd& motion) const;
  /// Adds `sign` times the forces on the unknowns. @param forces (3, #points) along x, y, z. @param sum (unknowns)
  void add_force(const Eigen::Matrix3Xd& forces, double sign, Eigen::VectorXd& sum) const;
  /// Tangent of this block's unknowns with those of another one at the same points. (unknowns, other's unknowns)
  [[nodiscard]] Eigen::MatrixXd tangent(const PointStiffnesses& stiffnesses, const BlockRows& other) const;
  /// Displacements of the points due to a change of the position's coefficients, along x, y, z. @param change (p, 3)
  /// @return (3, #points); no columns if fixed
  [[nodiscard]] Eigen::Matrix3Xd displacements(const Eigen::MatrixX3d& change) const;
  /// Rows of some of the points, without displacements where the block is supported. @param points indices
  [[nodiscard]] BlockRows at_points(const std::vector<Eigen::Index>& points) const;
  /// Square of the norm of the row of a point along a direction.
  [[nodiscard]] double squared_row(Eigen::Index point, const Eigen::Vector3d& direction) const;

 private:
  /// True if the block is free and of order 1.
  [[nodiscard]] bool is_affine() const { return same_ && values_[0].cols() == 4; }
  [[nodiscard]] const Eigen::MatrixXd& values(int axis) const {
    return values_[static_cast<std::size_t>(same_ ? 0 : axis)];
  }
  [[nodiscard]] Eigen::Index start(int axis) const { return starts_[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] Eigen::Index count(int axis) const { return start(axis + 1) - start(axis); }

  bool same_ = true;                        ///< the same for all components
  std::array<Eigen::MatrixXd, 3> values_;   ///< Phi_i; only the first for free blocks
  std::array<Eigen::Index, 4> starts_{};    ///< first unknown of each component, and their number
  std::array<Eigen::VectorXd, 3> squares_;  ///< squared norms of the rows of Phi_i
  Eigen::MatrixXd supported_;               ///< (#points, p) values where Phi_i differ from them
};

}  // namespace ashlar

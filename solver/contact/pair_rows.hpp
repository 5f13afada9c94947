// Kinematics of a contact pair within a step: motion of the points with the unknowns of both blocks, and forces on
// the unknowns due to forces at the points.
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "mechanics/contact/contact_points.hpp"
#include "mechanics/contact/laws/point_force.hpp"
#include "mechanics/contact/laws/tie.hpp"
#include "solver/contact/block_rows.hpp"

namespace ashlar {

/// Response of all points of a pair over a step.
struct PairResponse {
  std::vector<PointResponse> points;  ///< at the end of the step
  std::vector<MeanResponse> means;    ///< act in the equations of motion
  Eigen::VectorXd force_on_a;         ///< of the springs, (unknowns of a)
  Eigen::VectorXd force_on_b;         ///< (unknowns of b)
  Eigen::VectorXd shift_on_a;  ///< by forces shifted to common points, see PairRows; empty unless both blocks
                               ///< are free
  Eigen::VectorXd shift_on_b;

  [[nodiscard]] Eigen::VectorXd total_on_a() const { return sum(force_on_a, shift_on_a); }
  [[nodiscard]] Eigen::VectorXd total_on_b() const { return sum(force_on_b, shift_on_b); }
  /// total_on_a() or total_on_b() in memory that is there.
  void set_total(bool on_a, Eigen::VectorXd& total) const {
    total = on_a ? force_on_a : force_on_b;
    if (const Eigen::VectorXd& shift = on_a ? shift_on_a : shift_on_b; shift.size() > 0) total += shift;
  }

 private:
  static Eigen::VectorXd sum(const Eigen::VectorXd& force, const Eigen::VectorXd& shift) {
    return shift.size() > 0 ? Eigen::VectorXd(force + shift) : force;
  }
};

/// Derivatives of the points of a response.
[[nodiscard]] std::vector<PointDerivative> derivatives_of(const PairResponse& response);

/// Mean deformation of a free block over a step.
struct MeanDeformation {
  std::shared_ptr<const BlockParts> parts;
  Eigen::Matrix3d start = Eigen::Matrix3d::Identity();  ///< gradient at the start of the step

  /// Sets B m of PairRows. @param change of the unknowns. @param m (3, 3). @param result (3 p)
  void lever(const Eigen::VectorXd& change, const Eigen::Matrix3d& m, Eigen::VectorXd& result) const;
};

/// A block in the middle and at the end of a step, at a guess of its unknowns.
struct BlockInStep {
  const BlockModel* model;
  Eigen::MatrixX3d middle;      ///< position, (p, 3)
  Eigen::MatrixX3d end;         ///< position, (p, 3)
  Eigen::MatrixX3d prescribed;  ///< change of the position by moving supports; empty: none
};

/// Tangents -d force / d unknowns of the points that are not open; `ba` is the block (b, a) transposed, (na, nb).
struct PairTangent {
  Eigen::MatrixXd aa;
  Eigen::MatrixXd ab;
  Eigen::MatrixXd bb;
};

/// Motion of a relative to b at each point along its normal and tangents, C_a ya - C_b yb, with ya, yb the changes of
/// the blocks' unknowns (theory.md section 7, where H = C_a, Q = C_b). Rows are those at the start of the step until
/// they are followed (notes/contact_at_the_end_of_a_step.md).
///
/// The force f of a point acts on a at x_a and on b at x_b, the places of the material points in the middle of the
/// step. If these differ by r = x_a - x_b, both forces of free blocks are shifted to the midpoint between them, so
/// that they have no couple: by -1/2 B (r f') on each block, with
///   B = G inverse(F),  sum_k x_k B_k = I    G: mean gradients of the functions, F: mean deformation gradient
/// in the middle of the step. This is the force at the common point of an affine block, and has its resultant and
/// torque for any block. Normal forces are not shifted along the normal.
///
/// Points belong to the pair of the rows, and are passed to all functions that need their frames.
class PairRows {
 public:
  /// Rows of both blocks: data that are valid as long as the points.
  struct Values {
    BlockRows a;
    BlockRows b;
    double longest_a = 0.0;  ///< norm of the longest row; 0: fixed
    double longest_b = 0.0;
  };
  [[nodiscard]] static std::shared_ptr<const Values> values_of(const BlockModel& a, const BlockModel& b,
                                                               const std::vector<ContactPoint>& points);

  /// @param tie null for contacts; otherwise points represent its functions
  PairRows(const ContactBody& a, const ContactBody& b, const std::vector<ContactPoint>& points,
           std::shared_ptr<const Tie> tie = nullptr);
  /// From known rows of contacts. @param values values_of() the points
  PairRows(const ContactBody& a, const ContactBody& b, const std::vector<ContactPoint>& points,
           std::shared_ptr<const Values> values);
  [[nodiscard]] const std::shared_ptr<const Values>& values() const { return values_; }

  /// @return (3, #points), m
  [[nodiscard]] Eigen::Matrix3Xd motion(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const;
  /// Part linear in the changes: motion() without that of moving supports.
  [[nodiscard]] Eigen::Matrix3Xd free_motion(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const;
  /// Difference of the gaps at the end of the step from the linear ones, m; empty: none.
  [[nodiscard]] const Eigen::RowVectorXd& bent() const { return bent_; }

  /// Sets the motion of moving supports, in addition to that of the unknowns. @param change_a,change_b (p, 3), empty:
  /// none
  void prescribe(const std::vector<ContactPoint>& points, const BlockModel& a,
                 const Eigen::MatrixX3d& change_a, const BlockModel& b, const Eigen::MatrixX3d& change_b);
  void prescribe_nothing() { prescribed_.resize(3, 0); }
  /// Work of forces on the motion of supports, J.
  [[nodiscard]] double prescribed_work(const PairResponse& response) const;

  /// Updates rows and frames of the points to the middle of the step and gaps to its end, at a guess of the unknowns.
  void follow(std::vector<ContactPoint>& points, const BlockInStep& a, const BlockInStep& b,
              const Eigen::VectorXd& ya, const Eigen::VectorXd& yb);
  /// Updates rows and frames of the points to the end of the step.
  void go_to_end(std::vector<ContactPoint>& points, const BlockInStep& a, const BlockInStep& b);

  /// Sets the forces on the unknowns of both blocks. @param forces (3 #points), N
  void set_forces(const Eigen::VectorXd& forces, PairResponse& response) const;
  /// Sets the forces due to the shift to common points, for free blocks. @param motion at ya and yb
  void set_shifts(const Eigen::Matrix3Xd& motion, const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                  const Eigen::VectorXd& forces, PairResponse& response) const;

  /// @param derivatives here and below (#points)
  [[nodiscard]] PairTangent tangent(std::span<const PointDerivative> derivatives) const;
  /// Tangent of each point, along x, y, z: symmetric.
  [[nodiscard]] PointStiffnesses stiffnesses(std::span<const PointDerivative> derivatives) const;
  /// Coupling of each point, along x, y, z: the unsymmetric part of the Jacobian of -force. Without columns if no
  /// point has any
  [[nodiscard]] PointStiffnesses couplings(std::span<const PointDerivative> derivatives) const;
  /// Adds the product of point stiffnesses and changes of the unknowns: forces on the unknowns of a and b, N, with
  /// the sign of the tangent. @param da,db,on_a,on_b (unknowns), empty for fixed blocks
  void add_product(const PointStiffnesses& stiffnesses, const Eigen::VectorXd& da, const Eigen::VectorXd& db,
                   Eigen::VectorXd& on_a, Eigen::VectorXd& on_b) const;

  /// Norm of the longest row of each block; 0: fixed.
  [[nodiscard]] double longest_of_a() const { return values_->longest_a; }
  [[nodiscard]] double longest_of_b() const { return values_->longest_b; }
  /// Displacement of a row in a step per unit force, m/N, mean of some rows: independent of the orientation of axes.
  /// @param inertia_a,inertia_b density over the step squared, kg/(m^3 s^2)
  [[nodiscard]] double mobility(Eigen::Index first, Eigen::Index count, double inertia_a,
                                double inertia_b) const;

 private:
  /// Sets rows and frames from contact points in a configuration.
  void act_at(const std::vector<ContactPoint>& acting, const BlockInStep& a, const BlockInStep& b,
              std::vector<ContactPoint>& points);

  PairRows(const ContactBody& a, const ContactBody& b, const std::vector<ContactPoint>& points,
           std::shared_ptr<const Values> values, std::shared_ptr<const Tie> tie);
  /// Normal, tangent 1 and tangent 2 of a point, as columns.
  [[nodiscard]] auto frame(Eigen::Index point) const { return frames_.middleCols<3>(3 * point); }
  /// Forces along normals and tangents as forces along x, y, z. @param forces (3 #points). @return (3, #points)
  [[nodiscard]] Eigen::Matrix3Xd along_axes(const Eigen::VectorXd& forces) const;

  std::shared_ptr<const Values> values_;
  Eigen::Matrix3Xd frames_;      ///< (3, 3 #points)
  Eigen::Matrix3Xd prescribed_;  ///< change of both by moving supports; empty: none
  Eigen::Index count_;           ///< of points
  std::shared_ptr<const Tie> tie_;
  bool free_pair_;                 ///< neither block is supported or tied otherwise
  MeanDeformation deformation_a_;  ///< of free pairs
  MeanDeformation deformation_b_;
  Eigen::Matrix3Xd apart_;   ///< r in the middle of the step without motion
  Eigen::RowVectorXd bent_;  ///< m; empty: none
};

}  // namespace ashlar

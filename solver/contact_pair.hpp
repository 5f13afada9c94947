// The contact of two blocks within one step: constant rows, and forces as a function of both blocks'
// unknowns.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "mechanics/contact_memory.hpp"
#include "mechanics/contact_points.hpp"

namespace ashlar {

/// Response of all points of a pair over a step.
struct PairResponse {
  std::vector<PointResponse> points;  ///< at the end of the step
  std::vector<MeanResponse> means;    ///< what acts in the equations of motion
  Eigen::VectorXd force_on_a;         ///< (unknowns of a)
  Eigen::VectorXd force_on_b;         ///< (unknowns of b)
};

/// Constant after construction. Points are linear in the unknowns within a step: with ya, yb the changes of
/// the blocks' unknowns,  gap = g0 + n . (C_a ya - C_b yb)  and likewise the slip (theory.md section 7; H =
/// rows_a, Q = rows_b).
class ContactPair {
 public:
  /// @param a,b indices of the blocks, used by the solver only
  ContactPair(int a, int b, const BlockModel& model_a, const BlockModel& model_b, const JointLaw& law,
              std::vector<ContactPoint> points, std::vector<PointMemory> memory);

  [[nodiscard]] int a() const { return a_; }
  [[nodiscard]] int b() const { return b_; }
  [[nodiscard]] const std::vector<ContactPoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<PointMemory>& memory() const { return memory_; }

  /// @param averaged false: forces are those at the end of the step; true: see MeanResponse
  [[nodiscard]] PairResponse respond(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                     bool averaged) const;
  /// Spring energy at the start of the step, J.
  [[nodiscard]] double start_energy() const;

  /// Tangents -d force / d unknowns of the points that are not open; `ba` is the block (b, a) transposed,
  /// (na, nb).
  struct Tangent {
    Eigen::MatrixXd aa;
    Eigen::MatrixXd ab;
    Eigen::MatrixXd bb;
  };
  [[nodiscard]] Tangent tangent(const PairResponse& response) const;

  /// Gap of each point, m.
  [[nodiscard]] std::vector<double> gaps(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const;
  /// Memory after an accepted step.
  [[nodiscard]] std::vector<PointMemory> memory_after(const PairResponse& response, const Eigen::VectorXd& ya,
                                                      const Eigen::VectorXd& yb) const;
  /// Work that sliding takes in the step, J, >= 0.
  [[nodiscard]] double friction_work(const PairResponse& response, const Eigen::VectorXd& ya,
                                     const Eigen::VectorXd& yb) const;
  /// Spring energy at the end of the step, J.
  [[nodiscard]] static double energy(const PairResponse& response);

 private:
  /// Gap and trial slip of every point. @return (3, #points)
  [[nodiscard]] Eigen::Matrix3Xd relative(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const;

  int a_;
  int b_;
  std::vector<ContactPoint> points_;
  std::vector<PointMemory> memory_;
  std::vector<PointLaw> laws_;
  std::vector<PointResponse> start_responses_;
  Eigen::Matrix3Xd start_;  ///< gap and slip at the start of the step
  Eigen::MatrixXd
      rows_a_;  ///< (3 #points, unknowns of a): normal, tangent 1, tangent 2 of each point; empty if fixed
  Eigen::MatrixXd rows_b_;
};

}  // namespace ashlar

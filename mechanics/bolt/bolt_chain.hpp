// Forces of a bolt for given deformations (bolt_kinematics.hpp), with the massless bar in between eliminated.
//
// The bar's stations have places w along the bar, the rock beside them u = L v (BoltShape::interpolation()). Springs:
//   bar     w_(i+1) - w_i   E A / distance of the stations, yields at the yield force, breaks at the rupture strain
//   grout   w_i - u_i       bond stiffness times the length of the cell, yields at bond strength times that length
//           (St. John and Van Dillen, Proc. 24th US Symp. Rock Mech., 1983)
//   dowel   q               shear stiffness in all directions across the bar, yields at the shear strength, where the
//           bar crosses a joint (Lorig, Int. Symp. on Fundamentals of Rock Joints, Bjorkliden, 1985)
// With the potentials of yielding_spring.hpp,
//
//   Pi(v) = min over w of  sum bar + sum grout + sum dowels
//
// is convex in v: its gradient are the forces, its Hessian, by elimination of w,  L' (D - D H^-1 D) L  with D the
// tangents of the grout and H the tridiagonal one of w, is positive semi-definite. w is found by Newton's method with a
// line search from its place in the memory, so that forces depend on v and the memory alone.
//
// A bar that is anchored at its ends is one spring. Grout of blocks that are absent holds nothing.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "mechanics/bolt/bolt_law.hpp"
#include "mechanics/bolt/bolt_memory.hpp"
#include "mechanics/bolt/bolt_shape.hpp"
#include "mechanics/bolt/yielding_spring.hpp"

namespace ashlar {

/// Response of a bolt within a step.
struct BoltResponse {
  Eigen::VectorXd
      force;  ///< derivative of the potential, (#deformations), N: opposite to the force on the blocks
  Eigen::MatrixXd tangent;        ///< (#deformations, #deformations), N/m, symmetric, positive semi-definite
  double stored = 0.0;            ///< J
  double dissipated = 0.0;        ///< J, >= 0, since the memory was committed
  std::vector<double> places;     ///< w, m
  std::vector<SpringPoint> bar;   ///< by spring of the bar
  std::vector<SpringPoint> bond;  ///< by station, positive where the bar is ahead of the rock
  std::vector<Eigen::Vector2d> dowels;   ///< force, N, by dowelled crossing
  std::vector<Eigen::Vector2d> sheared;  ///< plastic part of the step, m
};

/// Constant after construction.
class BoltChain {
 public:
  /// @param present by piece: false if its block is absent
  BoltChain(const BoltLaw& law, BoltShape shape, std::vector<bool> present);

  [[nodiscard]] const BoltLaw& law() const { return law_; }
  [[nodiscard]] const BoltShape& shape() const { return shape_; }
  [[nodiscard]] bool present(std::size_t piece) const { return present_[piece]; }

  /// A bolt that is installed at a deformation: without forces but for the pretension of the bar.
  [[nodiscard]] BoltMemory installed_at(const Eigen::VectorXd& deformation) const;
  /// @param with_tangent false: the tangent is left empty
  [[nodiscard]] BoltResponse respond(const Eigen::VectorXd& deformation, const BoltMemory& memory,
                                     bool with_tangent = true) const;
  /// Memory after an accepted step.
  [[nodiscard]] BoltMemory memory_after(const BoltResponse& response, const BoltMemory& memory) const;
  /// True if the steel has yielded anywhere, or at one spring of the bar.
  [[nodiscard]] bool has_yielded(const BoltMemory& memory) const;
  [[nodiscard]] bool has_yielded(const BoltMemory& memory, std::size_t spring) const;
  /// Marks springs of the bar that have reached the rupture strain. @param response at the memory's committed step
  /// @return true if any has ruptured
  bool rupture(const Eigen::VectorXd& deformation, const BoltResponse& response, BoltMemory& memory) const;

 private:
  struct Springs;
  [[nodiscard]] Springs springs_at(const std::vector<double>& places, const Eigen::VectorXd& rock,
                                   const BoltMemory& memory) const;
  [[nodiscard]] std::vector<double> balance(const Eigen::VectorXd& rock, const BoltMemory& memory,
                                            Springs& springs) const;
  void add_dowels(const Eigen::VectorXd& deformation, const BoltMemory& memory, BoltResponse& response,
                  bool with_tangent) const;
  [[nodiscard]] BoltResponse respond_between_ends(double elongation, const BoltMemory& memory) const;

  BoltLaw law_;
  BoltShape shape_;
  std::vector<bool> present_;
  std::vector<YieldingSpring> bar_;
  std::vector<double> lengths_;  ///< of the springs of the bar, m
  std::vector<YieldingSpring> bond_;
  std::vector<int> dowels_;  ///< crossings that are dowelled
};

}  // namespace ashlar

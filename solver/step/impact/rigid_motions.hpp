// Rigid motions of blocks, and of contact points with them, for impacts (restitution.hpp).
#pragma once

#include <Eigen/Dense>
#include <map>
#include <vector>

#include "geometry/index.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Rigid motions of a block, those that its supports leave and the others.
struct SupportedMotions {
  Eigen::MatrixXd free;    ///< orthonormal, (unknowns, at most 6)
  Eigen::MatrixXd driven;  ///< that supports prevent at least in part, orthonormal, (3p, the rest of 6)
  Eigen::VectorXd shares;  ///< squared length of the part that they prevent of each of these, of 1
};

/// Rigid motions and velocities of blocks, computed on first use. States and pairs do not change meanwhile.
class RigidMotions {
 public:
  RigidMotions(const BlockSystem& system, const std::vector<BlockState>& states)
      : system_(system), states_(states) {}

  [[nodiscard]] bool moves(int block) const { return system_.moving()[at(block)]; }
  /// Rigid motions that the supports of a block leave, orthonormal. @return (unknowns, at most 6)
  const Eigen::MatrixXd& modes(int block) { return of(block).free; }
  /// Rigid part of the velocity of the unknowns; zero of a block that does not move.
  Eigen::VectorXd velocity(int block);
  /// Velocity by moving supports, (p, 3): of a block that they move rigidly, the rigid motion that has their velocity where
  /// they are, without part in its modes; empty: none.
  const Eigen::MatrixX3d& driven_velocity(int block);
  /// Relative velocities of a pair's points along normals and tangents, m/s, computed on first use. @return (3, #points)
  const Eigen::Matrix3Xd& at_points(const ContactPair& pair);
  /// Accelerations of a pair's points by gravity and loads, along their normals, m/s^2.
  [[nodiscard]] Eigen::RowVectorXd accelerations(const ContactPair& pair, const StepProblem& problem) const;

 private:
  const BlockSystem& system_;
  const std::vector<BlockState>& states_;
  const SupportedMotions& of(int block);

  std::map<int, SupportedMotions> motions_;
  std::map<int, Eigen::MatrixX3d> driven_;
  std::map<const ContactPair*, Eigen::Matrix3Xd> at_points_;
};

}  // namespace ashlar

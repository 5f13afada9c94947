// Rigid blocks in finite displacements, along a moving support (support_movement.hpp) or a push (pushover.hpp): their
// placement, the slip of their joints, and the rigid model of the placement.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "solver/block_pair.hpp"
#include "solver/limit/rigid_model.hpp"
#include "solver/paths/support_movement.hpp"
#include "solver/paths/yielding_support.hpp"

namespace ashlar {

/// Largest gap of points in sizes of the smallest block: two blocks cannot meet undetected in half of it. Smaller values
/// shorten the steps of a path.
inline constexpr double largest_reach_share = 0.2;
/// Largest gap over the length of a step, as the shift of a point: programmes lose digits by larger ones, and smaller ones
/// let blocks close gaps that they do not reach.
inline constexpr double largest_shift = 1e3;
/// Of the largest force: a point under more pressure transmits it, and its slip counts.
inline constexpr double point_bears = 1e-3;
/// Displacement that stands for none in a quotient, m.
inline constexpr double least_displacement = 1e-300;

/// Placement of blocks, as a value.
struct FollowedPlace {
  double moved = 0.0;                 ///< q of the support, m
  std::vector<BlockState> states;     ///< by block
  std::vector<Eigen::Matrix3d> turn;  ///< of each block relative to its initial placement
  std::map<PairKey, double> slip;     ///< m, accumulated slip of joints under pressure
};

class FollowedBlocks {
 public:
  /// @param reach m, largest gap of detected points
  /// @throws std::invalid_argument as support_movement
  FollowedBlocks(const PlacedScene& scene, double reach);

  [[nodiscard]] FollowedPlace as_placed() const;
  /// Bodies and all points in reach, gaps in RigidPoint::contact. @param multiplied as rigid_model
  [[nodiscard]] RigidModel model_of(const FollowedPlace& placement,
                                    const std::vector<bool>& multiplied = {}) const;

  /// Largest displacement of any place of a body, m. @param travel by body, in coordinates of the model
  [[nodiscard]] double largest_travel(const RigidModel& model, const std::vector<BodyVelocity>& travel) const;
  /// Blocks that move by more than 1 % of the fastest one, ascending. @param velocity by body, in coordinates of the model
  [[nodiscard]] std::vector<int> moving_blocks(const RigidModel& model,
                                               const std::vector<BodyVelocity>& velocity) const;
  /// Moves bodies by exact rotations.
  void move(const RigidModel& model, const std::vector<BodyVelocity>& travel, FollowedPlace& placement) const;
  void place_support(int support, const MovementLaw& movement_law, double q, FollowedPlace& placement) const;

 private:
  [[nodiscard]] double radius_about(const RigidBody& body) const;
  /// Largest displacement of any place of a body, m.
  [[nodiscard]] double travel_of(const RigidBody& body, const BodyVelocity& travel) const;

  const PlacedScene& scene_;
  BlockSystem system_;          ///< with friction only, and points up to the reach
  std::vector<double> radius_;  ///< m, of each block about its centroid
};

/// The model midway through a motion, with updated centroids, places and frames of its points and unchanged loads and
/// gaps.
/// @param program of the model, with or without the support. @param travel m, by body of the programme
[[nodiscard]] RigidModel midway(const RigidModel& model, const ConeProgram& program,
                                const std::vector<BodyVelocity>& travel);

/// Gaps relative to a length, by point of a model, limited to largest_shift. Forces across larger gaps are detected when
/// gaps are closed.
[[nodiscard]] std::vector<double> gaps_over(const RigidModel& model, double length);

[[nodiscard]] std::vector<BodyVelocity> times(double factor, std::vector<BodyVelocity> travel);

/// True if forces of all points in reach cannot balance the loads: the squared motion by Gauss's principle exceeds
/// the gap between its primal and dual values.
[[nodiscard]] bool cannot_balance(ConeProgram& program, const std::vector<BodyVelocity>& load);

/// Size of the smallest block that may move, m: edge of the cube of the same volume.
[[nodiscard]] double smallest_size(const BlockSystem& system, const RigidModel& model);

}  // namespace ashlar

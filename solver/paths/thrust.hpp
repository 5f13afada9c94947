// Least and largest thrust of a structure between supports: the range of the horizontal force of blocks on a fixed
// one over all forces within the strengths of the joints that balance all blocks. The actual thrust lies in between.
// A support that yields by a negligible amount reduces it to the least value, one that presses in increases it to the
// largest (Heyman, The stone skeleton, Int. J. Solids Struct. 2 (1966) 249).
//
// The support is released along one coordinate (yielding_support.hpp). Thrust is the load on that coordinate, in
// balance with the others. Each extreme is a limit load (cone_program.hpp). Joints that crush have their pressure at
// centroids of parts, which makes the range smaller than it is.
#pragma once

#include <optional>
#include <vector>

#include "solver/block_pair.hpp"
#include "solver/limit/rigid_model.hpp"

namespace ashlar {

/// An extreme of the thrust.
struct ThrustState {
  double thrust = 0.0;  ///< N, > 0 away from the structure
  double gap = 0.0;     ///< between primal and dual value, relative to the thrust, or to the unit of force if
                        ///< that is larger
  std::vector<Vector3> force;        ///< N, by point of the model, on its first block
  std::vector<BodyVelocity> motion;  ///< motion of blocks with the support, by body, per unit movement of the
                                     ///< support
};

struct ThrustRange {
  int support;  ///< block
  std::optional<ThrustState> least;
  std::optional<ThrustState> most;  ///< empty: unbounded, the structure there resists any compression
};

/// Thrust of each fixed block under pressure of a moving one, by block number.
/// @param down direction of gravity, any length; zero: thrust is along the line from the centroid
/// @return empty if no forces within the strengths balance the loads
[[nodiscard]] std::vector<ThrustRange> thrust_ranges(const RigidModel& model, const Vector3& down,
                                                     int threads);

/// Divides the parts of joints that crush until pressure at their centroids and at their corners (crushing_joints.hpp)
/// has the same extremes of thrust, for thrust_ranges. The extremes differ by ThrustState::gap.
void divide_for_thrust(RigidModel& model, const Vector3& down, int threads);

/// Resultant of a joint and its place.
struct JointResultant {
  BlockPair blocks;
  Vector3 place;  ///< m, centre of the normal forces
  Vector3 force;  ///< N, on the first block
};
/// Resultants of all joints that transmit more than a millionth of the largest force. @param force N, by point of the
/// model
[[nodiscard]] std::vector<JointResultant> joint_resultants(const RigidModel& model,
                                                           const std::vector<Vector3>& force);

}  // namespace ashlar

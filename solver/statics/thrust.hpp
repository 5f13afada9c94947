// Least and most thrust of what stands between supports: the horizontal push of blocks on one that does not move, as
// far as forces within the strengths of the joints that balance all blocks allow. Between both lies what the structure
// really does; a support that gives way by next to nothing takes the thrust to the least, one that presses in to the
// most (Heyman, The stone skeleton, Int. J. Solids Struct. 2 (1966) 249).
//
// The support is let go along one coordinate (yielding_support.hpp). Thrust is the load on that coordinate, in balance
// with the others; its extremes are a limit load each (cone_program.hpp).
#pragma once

#include <optional>
#include <vector>

#include "solver/statics/rigid_model.hpp"

namespace ashlar {

/// An extreme of the thrust.
struct ThrustState {
  double thrust = 0.0;  ///< N, > 0 away from the structure
  double gap = 0.0;  ///< between primal and dual value, over the thrust, or the unit of force if that is more
  std::vector<Vector3> force;        ///< N, by point of the model, on its first block
  std::vector<BodyVelocity> motion;  ///< how blocks move with the support, by body, over the support's way
};

struct ThrustRange {
  int support;  ///< block
  std::optional<ThrustState> least;
  std::optional<ThrustState>
      most;  ///< empty: no bound, what stands there can be pressed as much as one likes
};

/// Of each block that does not move and that one presses on which does, by block number.
/// @param down direction of gravity, any length; zero: thrust is that along the line from the middle
/// @return empty if no forces within the strengths balance the loads
[[nodiscard]] std::vector<ThrustRange> thrust_ranges(const RigidModel& model, const Vector3& down,
                                                     int threads);

/// Where the resultant of a joint acts, and the resultant.
struct JointResultant {
  std::array<int, 2> blocks;
  Vector3 place;  ///< m, centre of the normal forces
  Vector3 force;  ///< N, on the first block
};
/// Of all joints that bear more than a millionth of the largest force. @param force N, by point of the model
[[nodiscard]] std::vector<JointResultant> joint_resultants(const RigidModel& model,
                                                           const std::vector<Vector3>& force);

}  // namespace ashlar

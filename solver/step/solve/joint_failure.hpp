// Failure of joints within the open-close iteration of a step.
//
// Joints with tensile strength resist any tension until the forces are balanced. If the balanced tension exceeds the
// strength, the most overstressed joints fail permanently and the iteration continues: there are no more rounds than
// joints. Strength that yields (PointLaw::yields) needs none. Cohesion likewise acts across gaps until a balance shows
// which points have opened. Bonds with fracture energy have a law without jumps (mechanics/contact/laws/softened_point.hpp),
// and fail in it.
#pragma once

#include <vector>

#include "solver/step/island/island_equations.hpp"

namespace ashlar {

class JointFailure {
 public:
  /// Bonds the joints of an island.
  explicit JointFailure(IslandProblem& problem);

  /// Fails the joints with at least half of the largest overstress, or if none is overstressed those that have
  /// opened.
  /// @param problem that of the constructor. @return true if any has failed
  bool break_joints(IslandProblem& problem) const;

 private:
  std::vector<std::vector<double>> strengths_;  ///< tensile strength of each point, N
};

}  // namespace ashlar

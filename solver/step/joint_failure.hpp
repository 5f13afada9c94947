// How joints fail within the open-close iteration of a step.
//
// Joints with tensile strength hold whatever pulls until that is balanced; where the balanced pull exceeds the strength
// the joints that are overstressed most break, for good, and the iteration goes on: there are no more rounds than
// joints. Cohesion likewise lasts across gaps until a balance shows which points have opened.
#pragma once

#include <vector>

#include "solver/step/island_equations.hpp"

namespace ashlar {

class JointFailure {
 public:
  /// Bonds the joints of an island. @param problem outlives this
  explicit JointFailure(IslandProblem& problem);

  /// Breaks the joints with at least half of the largest overstress, or where none is overstressed those that
  /// have opened. @return whether there are any
  bool break_joints();

 private:
  /// Points with cohesion that have opened by more than rounding may make fail. @return whether there are any
  bool open_joints();

  IslandProblem& problem_;
  std::vector<std::vector<double>> strengths_;  ///< tensile strength of each point, N
};

}  // namespace ashlar

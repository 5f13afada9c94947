// Augmented contact within the open-close iteration of a step.
//
// A step starts with the forces of the last one as multipliers (Uzawa, one update a step). Springs transmit the
// change of force. Each spring is stiff enough to hold its point within a quarter of
// settings.multipliers.penetration_tolerance of its initial place. If a pair would release more energy than its
// blocks have spent on it, its multipliers are lowered instead.
#pragma once

#include "solver/step/island/island_equations.hpp"

namespace ashlar {

class Augmentation {
 public:
  /// Stiffens springs as the balanced forces require, or lowers multipliers if no spring is too soft.
  /// @param problem the same in each call. @return true if anything has changed, on any process that shares the island
  bool adjust(IslandProblem& problem) {
    const IslandSums& sums = problem.sums();
    return sums.any(stiffen(problem)) || sums.any(lower_multipliers(problem));
  }

 private:
  /// Stiffens springs beside multipliers as the change of force in the step requires. @return true if any were too
  /// soft
  static bool stiffen(IslandProblem& problem);
  /// Applies to pairs that release more energy than their blocks have spent on them. Lowers the multipliers of points
  /// whose force falls in the step below the force at its end, so that the pair dissipates. A multiplier changes in
  /// proportion to the fall of its force, so that rounding errors have no effect. @return true if any was lowered
  bool lower_multipliers(IslandProblem& problem);

  double beyond_ = 0.5;  ///< multiple of the fall of force by which a multiplier is lowered below the force
                         ///< at the end
};

}  // namespace ashlar

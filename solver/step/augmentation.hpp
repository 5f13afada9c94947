// Augmented contact within the open-close iteration of a step.
//
// A step starts with the forces of the last one as multipliers (Uzawa, one update a step). What the forces change by is
// left to springs, each made as stiff as it takes to hold its point within a quarter of
// settings.multipliers.penetration_tolerance of where it was. A pair that would so give its blocks more than it has
// taken from them starts from less force instead.
#pragma once

#include "solver/step/island_equations.hpp"

namespace ashlar {

class Augmentation {
 public:
  /// @param problem outlives this
  explicit Augmentation(IslandProblem& problem) : problem_(problem) {}

  /// Stiffens springs, or where none is too soft lowers multipliers, as the balanced forces ask for. @return whether
  /// any have changed
  bool adjust() { return stiffen() || lower_multipliers(); }

 private:
  /// Makes springs beside multipliers as stiff as the step's change of forces asks for. @return whether any
  /// were too soft
  bool stiffen();
  /// Where a pair gives its blocks more than it has taken from them, points whose force falls in the step
  /// start it from less force than they end it with: then they take. Forces that hardly fall hardly change,
  /// so that rounding says nothing. @return whether any was lowered
  bool lower_multipliers();

  IslandProblem& problem_;
  double beyond_ = 0.5;  ///< multiples of a fall of force that multipliers are lowered below it
};

}  // namespace ashlar

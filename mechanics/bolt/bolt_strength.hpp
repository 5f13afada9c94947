// Strength of a bolt in the plastic limit: the forces that it can transmit at any deformation.
//
// Steel that yields keeps its force, grout that slips and dowels that yield keep theirs, so that the theorems of limit
// analysis hold (Chen and Liu, Limit analysis in soil mechanics, 1990, ch. 2). Pretension is a state of self-stress: a
// bar that yields transmits its yield force with or without it. A grouted bar counts in tension only: its compression
// between two blocks is that of their joint.
//
// Steel that breaks before it yields has no plastic limit. Such a bolt has no strength here, as blocks that stand
// without it stand with it. Steel that breaks at a larger strain counts in full: the analysis knows no deformation.
#pragma once

#include "mechanics/bolt/bolt_law.hpp"

namespace ashlar {

/// Forces that a bolt can transmit. Infinite: without a bound.
struct BoltStrength {
  double tension = 0.0;      ///< N, >= 0, of the bar
  double compression = 0.0;  ///< N, >= 0, of the bar
  double bond = 0.0;         ///< N/m, > 0, of the grout; infinite for a bar that is held at its ends
  double shear = 0.0;        ///< N, >= 0, of the dowel at a joint

  /// True if it transmits no force at all.
  [[nodiscard]] bool none() const { return tension == 0.0 && compression == 0.0 && shear == 0.0; }
};

[[nodiscard]] BoltStrength bolt_strength(const BoltLaw& law);

/// True if the steel breaks before it yields.
[[nodiscard]] bool is_brittle(const BoltLaw& law);

/// True if some force of the bolt has no bound: the steel of a bar that is held at its ends, steel and grout of a
/// grouted one, or its dowels.
[[nodiscard]] bool is_unlimited(const BoltLaw& law);

/// Rupture strain over yield strain; infinite: it does not break.
[[nodiscard]] double ductility(const BoltLaw& law);

}  // namespace ashlar

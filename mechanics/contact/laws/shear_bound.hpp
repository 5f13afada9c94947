// Bound of the shear force of a contact point.
#pragma once

namespace ashlar {

/// Bound of the shear force and its derivative by the normal force.
struct ShearBound {
  double value;  ///< N
  double slope;
};

}  // namespace ashlar

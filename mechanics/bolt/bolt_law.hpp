// Properties of a bolt or prop.
#pragma once

#include <limits>

namespace ashlar {

/// How the bar acts on the blocks.
enum class BoltAnchorage {
  grouted,  ///< bonded to every block along its length
  ends,     ///< held at its two ends only: end-anchored bolts, cables, tie rods and props
};

/// Constants of a bolt. Forces are positive in tension.
struct BoltLaw {
  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  BoltAnchorage anchorage = BoltAnchorage::grouted;
  double axial_stiffness = 0.0;       ///< E A, N, > 0
  double yield_force = unlimited;     ///< N, > 0, in tension and, where it resists it, in compression
  double rupture_strain = unlimited;  ///< > 0, of the bar between two stations (bolt_shape.hpp)
  double pretension = 0.0;            ///< N, >= 0, at installation
  bool tension = true;                ///< false: a prop that is not fastened to its blocks
  bool compression = true;            ///< false: slack, as of cables
  // grouted
  double bond_stiffness = 0.0;        ///< N/m per m of grout, > 0
  double bond_strength = unlimited;   ///< N/m, > 0
  double shear_stiffness = 0.0;       ///< N/m, >= 0, of the dowel at each joint that the bolt crosses
  double shear_strength = unlimited;  ///< N, > 0
};

}  // namespace ashlar

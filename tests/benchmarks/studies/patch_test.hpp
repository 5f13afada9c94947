// The contact patch test: two stacked blocks under a uniform pressure, with their sides supported against lateral
// expansion, so that the area is constant. The stress is -p everywhere and the compression of the springs is p/kn.
#pragma once

#include "mechanics/block/block_definition.hpp"

namespace ashlar {

/// Two cubes of 1 m, E = 1e9 Pa, their common faces divided into triangles that do not match, p = 1e6 Pa.
struct PatchTest {
  double poisson_ratio = 0.3;
  int order = 1;
  bool area_springs = true;
  bool curved_surface = true;
  double stiffness =
      1e9;               ///< kn, Pa/m; point springs have a quarter of it in N/m, for the faces' four corners
  int subdivisions = 1;  ///< uniform levels of the faces of blocks of order >= 2
  /// Total: static analysis. Incremental, which has none: `dda` steps from rest until motion has ceased.
  Formulation formulation = Formulation::total;
};

/// Infinite if no equilibrium was found.
struct PatchErrors {
  double stress;  ///< largest |sigma_zz + p|/p; of the total formulation only, else NaN
  double jump;    ///< largest |gap + p/kn| kn/p
};

[[nodiscard]] PatchErrors press(const PatchTest& patch);

}  // namespace ashlar

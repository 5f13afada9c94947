// The paper's example: a cube falls onto the free end of a cantilever bent by its own weight.
#pragma once

#include "apps/program/verify/placement.hpp"

namespace ashlar {

/// Variable parameters of the example. The others are fixed: cube of 1.5 m, cantilever 8 x 3 x 1 m clamped at x = 0,
/// density 3600, E = 5e8 Pa, nu = 0.2, friction angle 30 degrees.
struct FallingBlock {
  double drop = 1.0;   ///< m, of the cube above the undeformed cantilever
  double speed = 0.0;  ///< m/s, of the cube at the start, downwards
  double time_step = 1e-3;
  int order = 3;  ///< of the cantilever; the cube has order 1
  Formulation formulation = Formulation::total;
  bool area_springs = true;
  bool curved_surface = true;
  /// Pa/m, normal and shear. Point springs distribute the stiffness of area springs on the cube's face over its four
  /// corners.
  double stiffness = 5e10;
  double chord_tolerance = 7.5e-3;  ///< m, see SimulationSettings
  int subdivisions = 0;             ///< uniform levels of the cantilever's faces
  double allowed_depth = 0.0;       ///< m, see SimulationSettings
};

/// Block 0 is the cube, block 1 the cantilever, at rest under its weight.
[[nodiscard]] Simulation falling_block(const FallingBlock& example, const Placement& placement = {});

/// The centre of the cantilever's free end, a material point followed by every formulation, m.
[[nodiscard]] Vector3 falling_block_tip();

}  // namespace ashlar

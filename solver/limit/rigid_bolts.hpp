// Bolts, cables and props between rigid bodies (rigid_model.hpp), with the strengths of bolt_strength.hpp.
//
// A bar crosses from body to body. Its tension N_k at crossing k and the force of its grout in body g between two
// crossings obey
//
//   0 <= N_k <= Y,   |N_g - N_(g-1)| <= b L_g,   N_1 <= b L_0,   N_n <= b L_n
//
// with the yield force Y, the bond strength b and the lengths L in the bodies: a bar without mass. A crossing between
// two bodies is a point whose force is -N along the bar, from -min(Y, b L) to 0. Where the grout of a body between two
// crossings may slip, the bar in it is a body of its own that moves along the bar only, held by a point of bond of
// +- b L_g. Its mass changes accelerations, not the limit. Bars that are held at their ends have one crossing; a prop's
// force is from 0 to Y.
//
// A dowel is a point with a force across the bar up to its shear strength, whatever the tension, as in bolt_chain.hpp.
//
// Bars have the direction of the line between their ends, or at a crossing the mean direction of both pieces, at the
// present places of the blocks.
#pragma once

#include <vector>

#include "mechanics/bolt/bolt_strength.hpp"
#include "solver/limit/rigid_model.hpp"

namespace ashlar {

/// Adds bodies and points of all bolts that are installed and not broken. @pre blocks, centroids and masses of bodies
/// and the units of the model are known. @param points of the model, not yet sorted
void add_bars(const BlockSystem& system, const RunState& state, RigidModel& model,
              std::vector<RigidPoint>& points);

/// Force of a bar at one of its points.
struct BarForce {
  BarPoint of;
  double force =
      0.0;  ///< N: tension, force of the grout along the bar on the bar, or length of the shear force
  double share = 0.0;  ///< of its strength, 0 to 1; 0 without a bound
};

/// Forces of all points of bars, in the order of the model. @param force by point, in units of the model
[[nodiscard]] std::vector<BarForce> bar_forces(const RigidModel& model,
                                               const std::vector<Eigen::Vector3d>& force);

/// Bolts under forces of their crossings: tension that changes linearly along the grout of each body.
/// @param present states of the bolts; those without forces are unchanged
[[nodiscard]] std::vector<BoltState> bolts_under(const std::vector<BarForce>& forces,
                                                 const std::vector<Bolt>& bolts,
                                                 std::vector<BoltState> present);

}  // namespace ashlar

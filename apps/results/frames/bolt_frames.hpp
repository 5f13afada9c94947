// The bolts and props of a state as lines with their forces: bolts.pvd.
#pragma once

#include "apps/results/frames/vtu/vtu_writer.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// A line for each spring of a bar, between stations at their present places, of all that are installed.
/// Cell data:
///   axial_force  N, tension positive
///   shear_force  N, length of the force across the bar where it crosses a joint, 0 elsewhere
///   bond_force   N/m, force of the grout on the bar per length, mean of both stations; 0 without grout
///   state        0 elastic, 1 its grout slips or it yields in shear, 2 steel yields, 3 ruptured: there, so far
///   bolt         number of the bolt or prop
[[nodiscard]] UnstructuredGrid bolt_frame(const Simulation& simulation);

}  // namespace ashlar

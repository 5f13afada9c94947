// The contact faces of a state as polygons, with what each bears: joints.pvd.
#pragma once

#include "apps/results/vtu_writer.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// The overlap of each pair of sub-faces that meet, in the middle between them. Cell data, of the contact points on it:
///   opening          m, mean gap over their area; negative: depth
///   slip             m, vector: how far block_a has slid along block_b since both were placed (0: incremental blocks)
///   normal_traction  Pa, normal force over area, compression positive
///   shear_traction   Pa, length of the shear force over area
///   area             m^2, of the points: traction times area is the force
///   state            of most of the area: 0 open, 1 locked, 2 sliding
///   broken           1 where most of the area had strength and has lost it, else 0
///   block_a, block_b numbers of the blocks
/// Contacts at corners and crossing edges have no face. A point that is on no polygon, as blocks have moved in the step,
/// is one of the nearest polygon of its faces.
[[nodiscard]] UnstructuredGrid joint_frame(const Simulation& simulation);

}  // namespace ashlar

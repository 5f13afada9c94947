// The contact faces of a state as polygons with their forces: joints.pvd.
#pragma once

#include <vector>

#include "apps/results/frames/vtu/vtu_writer.hpp"
#include "geometry/subfaces/sub_face_surface.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Cells used to draw joints, by block: whole convex faces of affine blocks, triangles of others. They do not depend
/// on the results of a run, so that a continued run draws the same. Incremental blocks have none here: theirs are
/// those of the contact search, which are constant.
[[nodiscard]] std::vector<SubFaceSurface> joint_surfaces(const std::vector<BlockModel>& blocks);

/// The overlap of each pair of cells in contact, midway between them. Cell data, from the contact points on it:
///   opening          m, mean gap over their area; negative: depth
///   slip             m, vector: slip of block_a along block_b since both were placed (0: incremental blocks)
///   normal_traction  Pa, normal force over area, compression positive
///   shear_traction   Pa, length of the shear force over area
///   water_pressure   Pa, in the middle; only where the scene has water
///   fracture_energy  J/m^2, dissipated by softening (lost_strength.hpp); only of joints that soften, in one process
///   area             m^2, of the points: traction times area is the force
///   state            of most of the area: 0 open, 1 locked, 2 sliding (contact_state.hpp)
///   broken           1 if most of the area had strength and has failed, else 0
///   block_a, block_b numbers of the blocks
/// Contacts at corners and crossing edges have no face. A point outside all polygons, as blocks have moved in the
/// step, is assigned to the nearest polygon of its faces.
/// @param surfaces from joint_surfaces. @param softens true: joints have fracture energy
[[nodiscard]] UnstructuredGrid joint_frame(const Simulation& simulation,
                                           const std::vector<SubFaceSurface>& surfaces, bool softens);

}  // namespace ashlar

// The contact faces of a state as polygons, with what each bears: joints.pvd.
#pragma once

#include <vector>

#include "apps/results/vtu_writer.hpp"
#include "geometry/subfaces/sub_face_surface.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// The cells that joints are drawn with, by block: whole convex faces of blocks that stay affine, triangles of others.
/// They do not depend on what a run has found, so that a run that goes on draws the same. Incremental blocks have none
/// here: theirs are those of the contact search, which never change.
[[nodiscard]] std::vector<SubFaceSurface> joint_surfaces(const std::vector<BlockModel>& blocks);

/// The overlap of each pair of cells that meet, in the middle between them. Cell data, of the contact points on it:
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
/// @param surfaces as of joint_surfaces
[[nodiscard]] UnstructuredGrid joint_frame(const Simulation& simulation,
                                           const std::vector<SubFaceSurface>& surfaces);

}  // namespace ashlar

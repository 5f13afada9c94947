// Models of COMPAS as JSON: what compas.json_dump writes of the packages compas_dem (Problem, BlockModel), compas_assembly
// and compas_cra (Assembly), and of meshes. Lengths are read as m, forces as N, angles as degrees.
//
// Read: meshes and polyhedra of blocks with their transformations, supports, densities of materials; of a Problem
// gravity, body forces, point and surface loads, displacements of supports, Mohr-Coulomb friction and cohesion. Blocks
// have the numbers of their nodes as names, as in COMPAS. Contacts that the file lists are found again from the
// geometry. A block is a rigid body, as for the solvers of COMPAS.
#pragma once

#include <string_view>

#include "apps/scene/import/imported_model.hpp"

namespace ashlar {

/// Gravity and friction that compas_dem's solvers use where a file gives none.
inline constexpr double compas_gravity = 9.81;  ///< m/s^2, downwards
inline constexpr double compas_friction = 0.6;  ///< coefficient

/// @param text of the file. @throws MeshFileError: no JSON (with line and column), no model of COMPAS, a block without
/// a mesh, an element of another kind of geometry, an unknown vertex, block, or material (with the path of the value)
[[nodiscard]] ImportedModel read_compas(std::string_view text);

}  // namespace ashlar

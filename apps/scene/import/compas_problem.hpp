// A Problem of compas_dem beside its model: boundary conditions and contact properties.
#pragma once

#include <map>
#include <string>

#include "apps/scene/import/imported_model.hpp"
#include "apps/scene/meshes/json_node.hpp"

namespace ashlar {

/// Values without the envelope { dtype, data } (before COMPAS 1.17 { dtype, value }) of an object.
[[nodiscard]] JsonNode compas_content(const JsonNode& written);

/// A member of an object; empty if it is missing or null.
[[nodiscard]] std::optional<JsonNode> compas_member(const JsonNode& node, const char* name);

/// A Point, Vector, or list of three numbers.
[[nodiscard]] Vector3 compas_vector(const JsonNode& written);

void assume_compas_friction(ImportedModel& model);

/// Adds loads, supports and contact properties to the blocks. Forces act at the point that is given, else at the centroid
/// of the block; a surface load at the centroid of its polygon. Rotations that are prescribed, and displacements of some
/// components, are left out. @param block_of indices of blocks by the numbers of their nodes. @throws MeshFileError
void read_compas_problem(const JsonNode& problem, ImportedModel& model,
                         const std::map<std::string, std::size_t>& block_of);

}  // namespace ashlar

// Keys with valid, but implausible values.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/expanded_scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// A block from a mesh file without scale whose width relative to the widest other block exceeds this is assumed to
/// be in millimetres.
inline constexpr double mesh_in_millimetres = 100.0;

/// Warns, at its key, of
///   friction_angle          above 0 and below 1 degree: a coefficient, or radians
///   no friction_angle       if two or more blocks are not tied: inclined blocks cannot stand
///   gravity                 with a positive z; for a history, its first row
void warn_of_implausible_keys(const ExpandedScene& scene, Diagnostics& diagnostics);

/// Warns of meshes that are probably in millimetres. @param solids one per scene.block; missing ones are ignored
void warn_of_mesh_units(const ExpandedScene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                        Diagnostics& diagnostics);

}  // namespace ashlar

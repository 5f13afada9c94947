// Keys that are good by themselves and hardly mean what they say.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// A block from a mesh file without scale that is this many times as wide as the widest other block is taken
/// to be in millimetres.
inline constexpr double mesh_in_millimetres = 100.0;

/// Warns, at its key, of
///   friction_angle          above 0 and below 1 degree: a coefficient, or radians
///   no friction_angle       where two or more blocks are not tied: nothing that leans or slopes stands
///   gravity                 that points upwards, z being up; of a history, its first row
void warn_of_doubtful_keys(const Scene& scene, Diagnostics& diagnostics);

/// Warns of meshes that are probably in millimetres. @param solids one per scene.block; those that are
/// missing are passed over
void warn_of_mesh_units(const Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                        Diagnostics& diagnostics);

}  // namespace ashlar

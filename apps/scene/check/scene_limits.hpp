// Valid numbers that exceed double precision in combination with others of the scene.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/expanded_scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Reports, at its key, each
///   a block                                           below 1e-50 or above 1e50 m: its moments are out of range
///   contact.distance, contact.penetration_tolerance   below the rounding error of coordinates: such distances
///                                                     cannot be distinguished from contact
///   time_step                                         below the rounding error of end_time
///   velocity, angular_velocity                        that moves a block by more than its size, or rotates it by more
///                                                     than 1 rad, in time_step / 4096, the shortest step of
///                                                     open-close iterations
///   a support's history                               with displacements at which coordinates are rounded to more than
///                                                     1e-6 of the block's size, the tolerance of overlaps
/// @param solids one per scene.block; missing ones are ignored
void check_limits(const ExpandedScene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                  Diagnostics& diagnostics);

}  // namespace ashlar

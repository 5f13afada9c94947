// Numbers that are good by themselves and that doubles cannot follow beside the others of the scene.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Reports, at its key, each
///   a block                                           below 1e-50 or above 1e50 m: its moments are no
///                                                     doubles
///   contact.distance, contact.penetration_tolerance   below the rounding of coordinates: what is nearer
///                                                     cannot be told from what touches
///   time_step                                         below the rounding of end_time
///   velocity, angular_velocity                        that moves a block by more than its size, or turns it
///                                                     by more than 1 rad, in time_step / 4096, the shortest
///                                                     step that open-close iterations may ask for
///   a support's history                               that goes so far that coordinates there are rounded to
///                                                     more than 1e-6 of the block's size, as overlaps are
///                                                     judged by
/// @param solids one per scene.block; those that are missing are passed over
void check_limits(const Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                  Diagnostics& diagnostics);

}  // namespace ashlar

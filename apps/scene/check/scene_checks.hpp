// Checks of a scene that involve several of its tables, or the placed solids.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/expanded_scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Names are unique and, if referred to, known; every [[joint]] matches a pair; the step fits the time. Values
/// refused by the reader are not reported again.
void check_references(const Scene& scene, Diagnostics& diagnostics);
/// The same. @param of_blocks receives unknown names of blocks in [[joint]] and [[measure]]
void check_references(const Scene& scene, Diagnostics& diagnostics, Diagnostics& of_blocks);

/// Names of cuts are unique, joints name existing cuts, and names of blocks are unique.
/// @param scene as read: its cuts have not been made
void check_cuts(const Scene& scene, Diagnostics& diagnostics);

/// Points of measures, supports and loads are points of their block, and planes contain a face of it. Points are
/// checked against the solid's bounding box (see placement_tolerance). Blocks without a solid are ignored.
/// @param solids one per scene.block.
void check_placement(const ExpandedScene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                     Diagnostics& diagnostics);

}  // namespace ashlar

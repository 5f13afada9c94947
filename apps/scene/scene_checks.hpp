// Checks of a scene that need more than one of its tables, or the placed solids.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Names are unique and, where something refers to them, known; every [[joint]] matches a pair;
/// the step fits the time. A value that the reader has already refused is not complained about again.
void check_references(const Scene& scene, Diagnostics& diagnostics);
/// The same. @param of_blocks is told of names in [[joint]] and [[measure]] that no block has
void check_references(const Scene& scene, Diagnostics& diagnostics, Diagnostics& of_blocks);

/// Before anything is cut: names of cuts are unique, joints name cuts that there are, and names of blocks are
/// unique.
void check_cuts(const Scene& scene, Diagnostics& diagnostics);

/// Points of measures, supports and loads are points of their block, and planes have a face of it. Points are
/// held to the solid's bounding box (see placement_tolerance), blocks without a solid are passed over.
/// @param solids one per scene.block.
void check_placement(const Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                     Diagnostics& diagnostics);

}  // namespace ashlar

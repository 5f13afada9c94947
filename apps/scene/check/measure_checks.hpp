// Checks of [[measure]] of drifts and cracks.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Reports names that match nothing. @param of_blocks receives faults of names
void check_group_measures(const Scene& scene, Diagnostics& of_blocks);

/// Reports levels of drifts that cut none of their blocks. @param solids placed, one per block
void check_levels(const Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                  Diagnostics& diagnostics);

}  // namespace ashlar

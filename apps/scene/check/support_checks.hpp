// Checks of bolts and props.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/expanded_scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Reports names that are given twice, bolts and props that hold no blocks, measures and removals of unknown ones, and
/// movements of supports beside them. Warns of bolts in a single block, and of properties without effect on limit
/// analysis and thrust, if the scene asks for them.
/// @param whole of all stages. @param solids by block; empty: not built
void check_supports(const ExpandedScene& whole, const std::vector<std::optional<Polyhedron>>& solids,
                    Diagnostics& diagnostics);

}  // namespace ashlar

// Checks of [[boundary]].
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/expanded_scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Reports boundaries that meet no face of a moving block, faces of rigid blocks or of blocks with moving supports,
/// faces with a support or another boundary, and free-field boundaries without a base, with gaps, or with a wave.
/// @param stage a scene of one stage. @param solids by block; empty: not built
void check_boundaries(const ExpandedScene& stage, const std::vector<std::optional<Polyhedron>>& solids,
                      Diagnostics& diagnostics);

/// Warns of a motion that starts without the reaction that holds the weight, and of waves in statics alone.
/// @param whole of all stages
void warn_of_boundaries(const Scene& whole, Diagnostics& diagnostics);

}  // namespace ashlar

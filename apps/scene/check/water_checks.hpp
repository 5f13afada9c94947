// Checks of [[water]] and [initial_stress].
#pragma once

#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Reports names or globs that match no block and, if they may name joints, no [[cut]].
/// @param key of the list. @param what subject of the message
void check_patterns(const Scene& scene, const std::string& key, const std::vector<std::string>& patterns,
                    bool of_cuts, Diagnostics& of_blocks, const char* what);

/// Reports names that match nothing, and a level without height over a place.
/// @param of_blocks receives faults of names
void check_water(const Scene& scene, Diagnostics& diagnostics, Diagnostics& of_blocks);

/// Reports names of [initial_stress] that match nothing, and blocks that cannot have stress.
void check_initial_stress(const Scene& scene, Diagnostics& diagnostics, Diagnostics& of_blocks);

/// Direction against gravity, unit length; z without gravity.
[[nodiscard]] Vector3 up_of(const Scene& scene);

}  // namespace ashlar

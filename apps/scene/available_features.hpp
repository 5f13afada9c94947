// What of the scene format this version can simulate. The format is fixed ahead of the program: a key whose
// feature is not there is refused by name, never passed over.
#pragma once

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"

namespace ashlar {

/// Reports every key that was given a value this version cannot honour, at that value. Defaults are always
/// available.
void check_availability(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

// Checks of roughness in [contact], [[joint]] and [[stage.joint]].
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Reports what a rough joint does not have beside its roughness.
void check_roughness(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

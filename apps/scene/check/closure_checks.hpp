// Checks of maximum_closure in [contact], [[joint]] and [[stage.joint]].
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Reports what a joint that stiffens as it closes needs, and what it does not have beside that.
void check_closures(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

// Checks of what [contact] and each [[joint]] say about strength and dilation.
#pragma once

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"

namespace ashlar {

/// Residual values above those of joints that have not failed, and dilation above friction, are errors at their keys.
void check_joint_laws(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

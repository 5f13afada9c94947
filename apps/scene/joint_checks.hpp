// Checks of strength and dilation in [contact] and each [[joint]].
#pragma once

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"

namespace ashlar {

/// Reports residual values above those of intact joints, and dilation above friction, at their keys.
void check_joint_laws(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

// Checks of strength and dilation in [contact] and each [[joint]].
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Reports residual values above those of intact joints, and dilation above friction, at their keys.
void check_joint_laws(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

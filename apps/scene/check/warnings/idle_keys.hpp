// Keys of a scene that have no effect because of another key, although their author expects one.
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Warns of each key that was given and has no effect:
///   spectral_radius             without integrator "generalized-alpha"
///   integrator, mass_damping, stiffness_damping,
///   velocities that are not 0   in a static analysis
///   penetration_tolerance       without augmented
///   order                       of a fixed block
void warn_of_idle_keys(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

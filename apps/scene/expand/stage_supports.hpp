// Bolts and props of a staged analysis: each stage's scene lists those of all stages, in one order, so that a run goes
// on with the forces of the stage before.
#pragma once

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Adds the bolts and props of all stages of a scene, not yet installed.
void add_later_supports(const Scene& whole, Scene& scene);
/// Installs those of a stage and notes which it removes.
void change_supports(const Scene& whole, std::size_t stage, Scene& scene);

}  // namespace ashlar

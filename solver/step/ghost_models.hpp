// Models of ghosts as the run has changed them. A ghost is made as the run starts; since then its quiet faces may have
// been released, with a reaction that the loader of models does not know (quiet_release.hpp).
#pragma once

#include "solver/step/step_caches.hpp"

namespace ashlar {

/// Gives ghosts the models that their owners have. Collective; no effect if no block of the run has quiet faces.
void update_ghost_models(BlockSystem& system, RunState& state, StepCaches& caches);

}  // namespace ashlar

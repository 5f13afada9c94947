// Blocks that a static analysis cannot have, because nothing holds them.
#pragma once

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Reports blocks, or sets of them in contact with each other, that no support, contact or fixed block holds,
/// at the first one's place: a block alone with the rigid motions that its supports leave it. Contacts of the
/// initial state count as holding.
void refuse_loose_blocks(const Scene& scene, Simulation& simulation, Diagnostics& diagnostics);

}  // namespace ashlar

// Unsupported blocks, which a static analysis does not allow.
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Reports blocks, or sets of them in contact with each other, that are restrained by no support, contact or fixed
/// block, at the place of the first one; for a single block with the rigid motions allowed by its supports. Contacts
/// of the initial state count as restraints.
void refuse_loose_blocks(const Scene& scene, Simulation& simulation, Diagnostics& diagnostics);

}  // namespace ashlar

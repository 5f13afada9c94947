// Bolts and props of a scene as those of its simulation.
#pragma once

#include <vector>

#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/bolts/bolt.hpp"

namespace ashlar {

/// In an order that does not depend on the stage.
[[nodiscard]] std::vector<Bolt> bolts_of(const LoadedScene& loaded);

}  // namespace ashlar

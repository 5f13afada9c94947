// The initial stress of a scene as a field, and the start of its blocks.
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"
#include "mechanics/material/initial_stress.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Stress at places of a block (Pa, tension positive); empty: none. With k0 that of ground at rest (ground_stress.hpp),
/// along gravity, with the weight of the block's material if the scene gives none. None in blocks that the stage, or one
/// before it, has added. @param block,stage indices
[[nodiscard]] StressField initial_stress_of(const Scene& scene, std::size_t block, std::size_t stage);

/// Starts blocks under the initial stress of a scene. Warns of a stress that neither joints nor boundaries hold.
void start_under_stress(const Scene& scene, Simulation& simulation, Diagnostics& diagnostics);

}  // namespace ashlar

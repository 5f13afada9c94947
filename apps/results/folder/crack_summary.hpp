// The cracks of a run in its summary.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/scene/model/scene.hpp"
#include "solver/fracture/crack.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Adds `cracks`, and `cracks_left_whole`: names of blocks at their strength without room for a crack.
void add_cracks(nlohmann::ordered_json& summary, const CrackRecord& cracks, const Scene& scene,
                const Simulation& simulation);

}  // namespace ashlar

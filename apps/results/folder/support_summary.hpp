// `support` of summary.json: the forces of bolts and props at the end of a run.
#pragma once

#include <nlohmann/json.hpp>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// largest_tension, largest_compression, largest_shear: { force (N), name }, null if there is none; states: number of
/// bolts and props of each state; bolts: at most 1000 of those installed, those with the largest axial forces first:
/// { name, axial_force, shear_force, state }.
[[nodiscard]] nlohmann::ordered_json support_summary(const Simulation& simulation);

}  // namespace ashlar

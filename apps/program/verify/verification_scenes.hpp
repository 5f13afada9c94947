// Scenes of verification cases as users write them.
#pragma once

#include <string>

#include "apps/scene/assemble/build_simulation.hpp"

namespace ashlar {

/// The simulation of a scene in TOML. @throws std::runtime_error with its faults
[[nodiscard]] Simulation simulation_of(const std::string& text, const TrialFactors& factors = {});

}  // namespace ashlar

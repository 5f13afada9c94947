// Blocks that a stage adds where others have moved to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// The deepest overlap of a block that this stage adds with another one, both as they are placed now, by the points of
/// their meshes. No contact knows of it yet, so it may be what a depth may be that contacts do not know
/// (SimulationSettings::depth, notes/stages.md of the solver).
/// @param simulation at the start of a stage. @param was_absent by block: not there in the stage before
/// @return "what is wrong (value), what is allowed"; none: all fit
[[nodiscard]] std::optional<std::string> overlap_of_added(const Simulation& simulation,
                                                          const std::vector<bool>& was_absent);

}  // namespace ashlar

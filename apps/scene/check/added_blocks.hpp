// Initial overlap of blocks that a stage adds with blocks that have moved.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// The deepest overlap of a block added by this stage with another one, both at their present place, by the points of
/// their meshes. No contact knows this overlap yet, so that it may be as deep as the allowed unknown depth
/// (SimulationSettings::depth, notes/stages.md of the solver). With several processes collective, and the same on all.
/// @param simulation at the start of a stage. @param was_absent by block: absent in the stage before
/// @return "what is wrong (value), what is allowed"; empty if all fit
[[nodiscard]] std::optional<std::string> overlap_of_added(const Simulation& simulation,
                                                          const std::vector<bool>& was_absent);

}  // namespace ashlar

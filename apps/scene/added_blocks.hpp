// Blocks that a stage adds where others have moved to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// Overlap of an added block with one that was there, as a share of the smaller one's size (the cube root of its
/// volume), up to which it is taken as what ground has moved into the place of a support: contacts are free of
/// force there. What is deeper is an error of the model, as an overlap at the start of a run is.
inline constexpr double allowed_share_of_added = 1e-2;

/// The deepest overlap of a block that this stage adds with another one, both as they are placed now, by their corners.
/// @param simulation at the start of a stage. @param was_absent by block: not there in the stage before
/// @return "what is wrong (value), what is allowed"; none: all fit
[[nodiscard]] std::optional<std::string> overlap_of_added(const Simulation& simulation,
                                                          const std::vector<bool>& was_absent);

}  // namespace ashlar

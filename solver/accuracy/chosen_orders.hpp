// Orders that a block can have, for choices by accuracy.
#pragma once

#include "solver/run/simulation.hpp"

namespace ashlar {

/// Largest order chosen: a block that needs more has a corner or a clamp, where higher orders help little
/// (notes/accuracy.md).
inline constexpr int largest_chosen_order = 8;

/// True unless the block is fixed, rigid or incremental, or its order or material excludes it. Its shape still may.
[[nodiscard]] bool can_have_order(const BlockModel& block, int order);

/// Simulation::change_order. @return false if the shape of the block does not allow the order: nothing has changed then
[[nodiscard]] bool changed_order(Simulation& simulation, int block, int order);

}  // namespace ashlar

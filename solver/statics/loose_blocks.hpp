// Blocks without support, which no static analysis can hold.
#pragma once

#include <vector>

#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"
#include "solver/step/detect/step_contacts.hpp"

namespace ashlar {

/// Sets of blocks in contact with each other that no fixed block, contact or support restrains, including single
/// blocks whose supports allow any rigid motion. Each in order, and sets by their lowest block. With other processes collective:
/// the sets of all processes, the same on each.
[[nodiscard]] std::vector<std::vector<int>> loose_blocks(const BlockSystem& system, RunState& state,
                                                         StepContacts& contacts);

}  // namespace ashlar

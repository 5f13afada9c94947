// A run whose block is divided by a crack, between two steps (notes/cracks.md): the parts have the motion, the contacts and
// the supports of the block, and the traction that was between them.
//
// Mass, momentum and angular momentum are those of the block to rounding, and so is its energy but for the frame of linear
// elasticity, of which each part has its own: of the order of the product of stress and squared rotation within the block.
// This change is booked as numerical. The energy of the new springs is booked when the next step detects them.
#pragma once

#include "solver/fracture/divided_block.hpp"
#include "solver/fracture/divided_contacts.hpp"
#include "solver/run/checkpoint.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// The blocks of a run with the parts of one of them, undeformed: a state is to be restored.
/// @param run of one rank. @param parts the first one has the number of the block, the others follow all blocks
/// @param law of all pairs of the new blocks
[[nodiscard]] Simulation with_parts(const Simulation& run, const PartNumbers& divided,
                                    const std::vector<BlockPart>& parts, Simulation::LawOfPair law);

/// The state of a run for the same run with parts. Steps continue from it; a static analysis continues its load level.
/// @param divided_run of with_parts(). @param joint law between the parts
[[nodiscard]] SimulationSnapshot divided_state(const Simulation& run, const PartNumbers& divided,
                                               const std::vector<BlockPart>& parts, const JointLaw& joint,
                                               const Simulation& divided_run);

}  // namespace ashlar

// Where contact is augmented, multipliers hold points at the depth where they are found. What a step does not
// see, corners and faces that turn while it moves them straight, adds to that depth from step to step. Blocks
// that are deeper in each other than the tolerance allows are therefore moved apart between two steps, by the
// least motion that does it: they keep their velocities. To push them apart within a step would give them a
// velocity of depth over step.
//
// The motion lifts weights and strains blocks a little. It takes no more energy for that than contacts have
// taken from blocks before (contact_accounts.hpp). Free blocks that move apart as they pass each other would
// have another angular momentum: the set of them gets it back as a spin.
#pragma once

#include <vector>

#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Whether multipliers hold points so deep that a step could leave them beyond the penetration tolerance.
[[nodiscard]] bool too_deep(const RunContext& run, const std::vector<ContactPair>& pairs);

/// Moves the blocks of such points apart, before the step that a problem is for.
/// @param step s. @param problem its pairs are those of `found`
/// @param found replaced, and the pairs with it, where blocks would pass through each other on the way
/// @param additions times that this may happen
/// @return whether any was moved: contacts have to be detected anew then
bool project_positions(const RunContext& run, double step, StepProblem& problem,
                       std::vector<FoundContacts>& found, int additions);

}  // namespace ashlar

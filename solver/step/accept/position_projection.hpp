// Augmented contact: multipliers hold points at the depth where they are detected. Errors that a step does not see,
// such as corners and faces that turn while the step moves them straight, add to that depth from step to step. Blocks
// that penetrate deeper than the tolerance allows are therefore separated between two steps by the smallest motion
// that does so. They keep their velocities. To separate them within a step would give them a velocity of depth over
// step.
//
// The motion lifts weights and strains blocks a little. It requires no more energy than the blocks have spent on
// their contacts before (contact_accounts.hpp). It would change the angular momentum of free blocks that separate
// while they pass each other: their set gets it back as a spin.
#pragma once

#include <vector>

#include "solver/step/step_caches.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// True if multipliers hold points so deep that a step could leave them beyond the penetration tolerance. Collective.
[[nodiscard]] bool too_deep(const BlockSystem& system, const RunState& state,
                            const std::vector<ContactPair>& pairs);

/// Separates the blocks of such points before the step that a problem is for. Collective.
/// @param step s. @param problem its contacts and pairs are replaced if blocks would pass through each other on the
/// way, at most settings.multipliers.moves_apart times
/// @return true if any block was moved: contacts have to be detected again
bool project_positions(BlockSystem& system, RunState& state, StepCaches& caches, double step,
                       StepProblem& problem);

}  // namespace ashlar

// Puts islands to sleep that have come to rest, and wakes them. Blocks that sleep are held (BlockSystem::hold):
// no contact is looked for between them and what does not move, no equation is solved for them, their contacts,
// records and energies stay as they were. Decided by what blocks do, never by clocks of the machine.
//
// An island rests when, over the last two windows of settings.rest.window steps, each of its blocks
//   has moved by less than a share of the contact distance,
//   has moved in the second window by clearly less than in the first: it comes to a stop, and does not creep,
//     topple or slide on,
// and the mean force on it in the second is a small share of the largest.
// It wakes as a whole, at the start of a step, when a load, a support or gravity may change in the step, or when
// a block that moves has come within the distance at which contacts are found (notes/sleeping_islands.md).
#pragma once

#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Wakes what a step of this length may load or move by supports. @param step s
void wake_for_loads(const RunContext& run, double step);

/// Wakes islands that have a contact or a tie with a block that moves. @return whether any were; contacts have
/// to be detected again then
[[nodiscard]] bool wake_touched(const RunContext& run, const std::vector<ContactPair>& pairs);

/// Wakes everything; blocks start from rest.
void wake_all(const RunContext& run);

/// To be called with a step that was accepted, its motion and contacts taken over: notes what blocks moved, and
/// at the end of a window puts to sleep what rests. Kinetic energy that is left is booked as the integrator's.
void note_rest(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem);

/// Holds what a state says is asleep; to be called when another state was put in place of the present one.
void hold_sleepers(BlockSystem& system, const Sleep& sleep);

}  // namespace ashlar

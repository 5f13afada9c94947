// Puts islands that have come to rest to sleep, and wakes them. Sleeping blocks are held (BlockSystem::hold): no
// contact is searched between them and fixed blocks, and no equation is solved for them. Their contacts, records and
// energies stay unchanged. The decision depends on the motion of blocks only, never on run time.
//
// An island rests when, over the last two windows of settings.rest.window steps, each of its blocks
//   has moved by less than a share of the contact distance,
//   has moved in the second window by clearly less than in the first, so that it comes to rest and does not creep,
//     topple or slide on,
// and the mean force on it in the second window is a small share of the largest.
// It wakes as a whole, at the start of a step, when a load, a support or gravity may change in the step, or when
// a block that moves has come within the distance at which contacts are found (notes/sleeping_islands.md).
#pragma once

#include "solver/contact/contact_finder.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Wakes islands that a step of this length may load, or move by their supports. @param step s
void wake_for_loads(BlockSystem& system, RunState& state, double step);

/// Wakes islands that have a contact or a tie with a moving block. @return true if any were woken: contacts have to
/// be detected again
[[nodiscard]] bool wake_touched(BlockSystem& system, RunState& state, const std::vector<ContactPair>& pairs);

/// Wakes all islands; blocks start from rest.
void wake_all(BlockSystem& system, RunState& state);

/// Records the motion of blocks in an accepted step and, at the end of a window, puts resting islands to sleep. Their
/// kinetic energy is booked as the integrator's. @param state at the end of the step. @param finder of its contacts
void note_rest(BlockSystem& system, RunState& state, const ContactFinder& finder, const StepProblem& problem);

/// Holds the blocks that a state lists as sleeping. To be called when the present state was replaced.
void hold_sleepers(BlockSystem& system, const Sleep& sleep);

}  // namespace ashlar

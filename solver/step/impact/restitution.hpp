// Restitution: two blocks that meet part again with the share e of their approach velocity (Newton's law), whatever
// the step, the integrator, the stiffness of springs and the order of the blocks (notes/restitution.md).
//
// An impact has no duration here. The step in which a joint with restitution closes is cut so that it ends just before
// the touch, within `passing_share` of the contact distance. No spring or multiplier has acted then, and no block has
// been deformed. The next step begins with impulses on the rigid motions of the blocks (impact.hpp): vibrations keep
// their velocities, and contacts that bear at that moment transmit impulses without rebound. Impulses are bounded by
// friction. What they dissipate is booked as damping.
//
// Speeds below which there is no rebound, for a step dt and gravity g:
//     1.5 g dt      a block at rest on another one gains g dt in a step: contact at rest never is an impact
//     g dt/2e       the rebound would end within the step: e = 0
// Slower contacts are closed by springs or multipliers as without restitution.
#pragma once

#include <optional>
#include <vector>

#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Share of a solved step that ends just before the first impact in it; empty: there is none. Collective.
/// @param step its length, s
[[nodiscard]] std::optional<double> share_until_impact(const BlockSystem& system, const RunState& state,
                                                       double step, const StepProblem& problem);

/// Applies the impulses of blocks that are about to touch at the start of a step: changes velocities and books the
/// loss. Collective. @return true if there were any
bool rebound(const BlockSystem& system, RunState& state, const std::vector<ContactPair>& pairs);

}  // namespace ashlar

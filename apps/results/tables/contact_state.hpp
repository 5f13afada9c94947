// The states of contact points as results show them.
//
// A point is at its limit (ContactState::sliding of the solver) if its shear force is its strength. At rest that says
// little: where blocks are stiff the forces of the points of one joint are not unique, and some may be at their limit
// while the joint as a whole uses a small part of its strength. Results count a point at its limit as sliding only if
//   it moves:       its mean slip rate in the last step is more than 1e-6 of the smaller block's size per second, or
//   its joint does: the shear forces of all closed points of the two blocks have a resultant, or a moment about the
//                   centre of their strengths, of 99 % of the most that the points can resist.
// A static iteration is a step of blocks released from rest. All other points at their limit are shown as locked. The
// solver's own states, and so the motion, are unchanged.
#pragma once

#include <vector>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// 1/s, of the smaller block's size: slip rate from which on a point at its limit slides.
inline constexpr double still_slip_rate = 1e-6;
/// Share of its strength from which on a joint as a whole is at its limit.
inline constexpr double joint_limit_share = 0.99;

/// States of the points of a pair.
[[nodiscard]] std::vector<ContactState> shown_states(const Simulation& simulation, const PairRecord& record);

/// Of all contact points, as shown; of a run that processes share those of the results gathered last, if they are known.
[[nodiscard]] ShownContacts contact_counts(const Simulation& simulation);
/// Of the pairs that this process owns.
[[nodiscard]] ShownContacts own_contact_counts(const Simulation& simulation);

}  // namespace ashlar

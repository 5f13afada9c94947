// What the springs of pairs of blocks may hold when they are found anew (mechanics/contact/spring_energy.hpp): what
// they held at the end of the last step, and what other springs at the same block, found anew, no longer
// hold: a block that slides from one block to the next takes the energy of its springs along.
#pragma once

#include <vector>

#include "solver/contact/contact_pair.hpp"
#include "solver/contact/pair_history.hpp"

namespace ashlar {

/// @param pairs as found anew, at rest on the surface. @param histories of the pairs of blocks at the end
/// of the last step. @param moving blocks that springs' energy can go along with; springs between others are not found anew
/// @return bounds for ContactPair::hold_at_most, one for each pair: with them, all normal springs together
/// hold no more than at the end of the last step
[[nodiscard]] std::vector<SpringEnergy> energy_bounds(const std::vector<ContactPair>& pairs,
                                                      const PairHistories& histories,
                                                      const std::vector<bool>& moving);

}  // namespace ashlar

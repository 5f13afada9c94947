// Energy bounds of re-detected springs (mechanics/contact/spring_energy.hpp): their energy at the end of the last
// step plus the energy lost by other re-detected springs at the same block. A block that slides from one block to the
// next so transfers the energy of its springs.
#pragma once

#include <vector>

#include "solver/contact/contact_pair.hpp"
#include "solver/contact/pair_history.hpp"

namespace ashlar {

/// @param pairs as re-detected, unloaded at the surface. @param histories of the pairs at the end of the last step
/// @param moving blocks that can transfer spring energy; springs between other blocks are not detected again
/// @return bounds for ContactPair::hold_at_most, one for each pair: with them, all normal springs together hold at
/// most their energy at the end of the last step
[[nodiscard]] std::vector<SpringEnergy> energy_bounds(const std::vector<ContactPair>& pairs,
                                                      const PairHistories& histories,
                                                      const std::vector<bool>& moving);

}  // namespace ashlar

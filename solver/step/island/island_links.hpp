// Couplings of the bodies of an island, by which its matrix is laid out.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "solver/step/island/island.hpp"

namespace ashlar {

/// Pairs of places of bodies that contacts, ties or bolts couple: first those of the island's pairs, in their order, then
/// of bolts those that are not among them, the lower place first.
/// @param place by block: its place among the island's bodies
[[nodiscard]] std::vector<std::array<int, 2>> links_of(const Island& island,
                                                       const std::vector<ContactPair>& pairs,
                                                       const std::map<int, int>& place);

}  // namespace ashlar

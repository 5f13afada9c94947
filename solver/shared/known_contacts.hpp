// Contacts that ranks keep from step to step: all ranks detect the contacts of a pair again when its owner does, so that
// what is near to them is detected again as on one rank.
#pragma once

#include <vector>

#include "solver/contact/contact_finder.hpp"
#include "solver/state/block_system.hpp"

namespace ashlar {

/// Drops kept contacts of pairs of other ranks that these do not keep. Collective.
/// @param near pairs of the step. @param kept by near pair; null: to be detected
void drop_unknown_elsewhere(const BlockSystem& system, const std::vector<NearPair>& near,
                            std::vector<std::shared_ptr<const KeptContacts>>& kept);

}  // namespace ashlar

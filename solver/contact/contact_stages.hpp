// The stages in which the contacts of a step are made, and an observer of them.
//
// Each stage takes the list of contacts of a pair from the one before. Comparing the lists tells which stage added a
// contact and which one removed it (run/contact_explanation.hpp).
#pragma once

#include <functional>

#include "geometry/contacts/contact_search.hpp"
#include "solver/contact/pair_history.hpp"

namespace ashlar {

/// In the order in which they follow each other.
enum class ContactStage {
  search,  ///< features within reach that face each other (geometry/contacts/contact_search.hpp)
  area,    ///< overlaps without an area beyond rounding are removed (overlap_outline.hpp)
  occluded_faces,  ///< vertices below a face that lies on a third block are searched again (occluded_faces_of_step.hpp)
  entrance,       ///< convex blocks: completed and reduced by the exact contact of both (convex_search.hpp)
  internal_edge,  ///< contacts that only penetration has made are removed (internal_edges.hpp)
};

/// Called after each stage for each pair that was searched in it, one at a time. @param blocks the lower number first
using ContactObserver =
    std::function<void(ContactStage stage, const PairKey& blocks, const PairContacts& contacts)>;

}  // namespace ashlar

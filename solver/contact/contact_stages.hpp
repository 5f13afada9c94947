// The stages in which the contacts of a step are made, and an observer of them.
//
// Each stage modifies the list of contacts of a pair. A comparison of the lists shows which stage added or removed a
// contact (run/contact_explanation.hpp).
#pragma once

#include <functional>

#include "geometry/contacts/contact_search.hpp"
#include "solver/contact/pair_history.hpp"

namespace ashlar {

/// In order of execution.
enum class ContactStage {
  search,          ///< features within reach that face each other (geometry/contacts/contact_search.hpp)
  area,            ///< overlaps without an area beyond rounding are removed (overlap_outline.hpp)
  occluded_faces,  ///< vertices below a face that lies on a third block are searched again (covered_faces.hpp)
  entrance,        ///< convex blocks: completed and reduced by the exact contact of both (convex_search.hpp)
  internal_edge,   ///< contacts caused only by penetration are removed (internal_edges.hpp)
};

/// Called after each stage for each pair that was searched in it, one at a time. @param blocks the lower number first
using ContactObserver =
    std::function<void(ContactStage stage, const PairKey& blocks, const PairContacts& contacts)>;

}  // namespace ashlar

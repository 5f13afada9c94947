// All that is known of a pair of blocks from step to step: what its contacts remember, when it was last found
// apart, through which facets it was entered, what its contact forces have done, how deep the blocks are in
// each other and how deep they were placed.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>

#include "geometry/contacts/convex_search.hpp"
#include "mechanics/contact/contact_memory.hpp"
#include "solver/contact/lasting_contacts.hpp"

namespace ashlar {

/// Two blocks, the lower number first.
using PairKey = std::array<int, 2>;

/// A pair of blocks that was found apart.
struct Clearance {
  double distance;  ///< m, at least, when it was found
  double path;      ///< m, what both had gone until then
};

/// One pair of blocks. What is not known has its default.
struct PairHistory {
  ContactMemory memory;  ///< of the contacts of the last step; empty: there were none
  /// What was found at the last search, if it may last: where it has points, those of the memory; null: nothing
  std::shared_ptr<const LastingContacts> lasting;
  std::optional<Clearance> clearance;    ///< unless the last search found contacts
  std::optional<EntranceName> entrance;  ///< of convex pairs that were near each other at the last search
  double work = 0.0;     ///< of the contact forces on both blocks since the start of the run, J
  double taken = 0.0;    ///< what multipliers have taken from the blocks and not given back, J, >= 0
  double bonded = 0.0;   ///< m^2, the largest area that had strength to lose, and what of it has
  double broken = 0.0;   ///< m^2, lost it since the start of the run
  double depth = 0.0;    ///< true depth at the end of the last step, m, >= 0 (depth_audit.hpp)
  double overlap = 0.0;  ///< m, >= 0: how deep the blocks were placed in each other; gaps count from there

  /// How deep contacts may be that the next search has to find, m, >= 0: as contacts were, and between their
  /// points, or, where contacts did not know of it, as the blocks truly were.
  [[nodiscard]] double depth_to_search() const {
    return std::max(overlap + memory.deepest() + memory.bulge(), depth);
  }
};

/// By pair, in the order of block numbers. A pair has an entry from the first time that it is searched.
using PairHistories = std::map<PairKey, PairHistory>;

/// What is known of a pair, or that nothing is.
[[nodiscard]] const PairHistory& history_of(const PairHistories& histories, const PairKey& pair);

/// Drops entries in which nothing is left. Results do not depend on it.
void drop_empty(PairHistories& histories);

/// @throws std::logic_error if a value cannot be: a pair whose lower block is not first, a negative or not
/// finite work of multipliers, depth or clearance, memory of a face that no solid has. @param blocks their number
void validate(const PairHistories& histories, int blocks);

}  // namespace ashlar

// History of a pair of blocks from step to step: memory of its contacts, last clearance, facets of entrance, work of
// its contact forces, penetration and initial overlap.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>

#include "geometry/contacts/convex_search.hpp"
#include "mechanics/contact/contact_memory.hpp"
#include "solver/block_pair.hpp"
#include "solver/contact/contact_cache.hpp"

namespace ashlar {

/// A pair of blocks that was found apart.
struct Clearance {
  double distance;  ///< m, lower bound at that time
  double path;      ///< m, sum of both paths at that time
};

/// One pair of blocks. Unknown members have their default.
struct PairHistory {
  ContactMemory memory;  ///< contacts of the last step; empty: there were none
  /// Cached result of the last search. If it has points, the memory belongs to them; null: none
  std::shared_ptr<const ContactCache> cache;
  std::optional<Clearance> clearance;    ///< unless the last search found contacts
  std::optional<EntranceName> entrance;  ///< of convex pairs that were near each other at the last search
  double work = 0.0;     ///< of the contact forces on both blocks since the start of the run, J
  double spent = 0.0;    ///< energy that blocks have spent on multipliers and not got back, J, >= 0
  double bonded = 0.0;   ///< m^2, largest area with strength so far
  double broken = 0.0;   ///< m^2, failed part of it since the start of the run
  double depth = 0.0;    ///< true depth at the end of the last step, m, >= 0 (depth_audit.hpp)
  double overlap = 0.0;  ///< m, >= 0: initial overlap of the blocks; gaps are relative to it

  /// Depth up to which the next search has to find contacts, m, >= 0: depth of the contacts and between their points,
  /// or the true depth if the contacts missed it.
  [[nodiscard]] double depth_to_search() const {
    return std::max(overlap + memory.deepest() + memory.bulge(), depth);
  }
};

/// By pair, in the order of block numbers. A pair has an entry from its first search on.
using PairHistories = std::map<PairKey, PairHistory>;

/// History of a pair; the default if there is none.
[[nodiscard]] const PairHistory& history_of(const PairHistories& histories, const PairKey& pair);

/// Removes empty entries. Results do not depend on it.
void drop_empty(PairHistories& histories);

/// @throws std::logic_error if a value is invalid: a pair whose lower block is not first, a negative or not finite
/// work of multipliers, depth or clearance, memory of a face that no solid has. @param blocks their number
void validate(const PairHistories& histories, int blocks);

}  // namespace ashlar

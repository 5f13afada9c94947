// Decisions that ranks that share a run take together before it begins.
#pragma once

#include <iosfwd>
#include <string>

#include "apps/scene/assemble/run_ranks.hpp"

namespace ashlar {

/// True if several ranks share the runs of a program.
[[nodiscard]] bool are_several(const RunRanks* ranks);
/// True for the rank that writes results and messages.
[[nodiscard]] bool is_first(const RunRanks* ranks);

/// True if all ranks can go on. Messages are printed once, by the first rank: those of the lowest rank that cannot, or its
/// own. Collective. @param ranks null: one. @param messages of this rank, lines. @param err of this rank
[[nodiscard]] bool all_go_on(const RunRanks* ranks, bool good, const std::string& messages,
                             std::ostream& err);

}  // namespace ashlar

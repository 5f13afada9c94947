// `ashlar run`: simulate a scene and write its result folder.
#pragma once

#include <iosfwd>

#include "apps/program/run/run_options.hpp"

namespace ashlar {

struct RunRanks;  // run_ranks.hpp

/// @param out report on contacts, if requested. @param err faults and progress
/// @return exit status: 0 done; 1 the run failed, its last accepted state is saved; 2 bad input, nothing written,
/// also if the result folder is in use, of another kind or holds results that must be kept; 130 interrupted
/// (interrupt_guard.hpp), state saved.
/// @param ranks processes that share the run, null: this one alone. Collective: the status is the same on all, and the
/// first one writes results and messages
/// @throws std::runtime_error with path and reason if the page of --view cannot be written. On several ranks failures
/// that others do not share are thrown too
int run_command(const RunOptions& options, std::ostream& out, std::ostream& err,
                const RunRanks* ranks = nullptr);

}  // namespace ashlar

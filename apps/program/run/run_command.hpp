// `ashlar run`: simulate a scene and write its result folder.
#pragma once

#include <iosfwd>

#include "apps/program/run/run_options.hpp"

namespace ashlar {

/// @param out report on contacts, if requested. @param err faults and progress
/// @return exit status: 0 done; 1 the run failed, its last accepted state is saved; 2 bad input, nothing written,
/// also if the result folder is in use, of another kind or holds results that must be kept; 130 interrupted
/// (interrupt_guard.hpp), state saved.
/// @throws std::runtime_error with path and reason if the page of --view cannot be written.
int run_command(const RunOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ashlar

// `ashlar run`: simulate a scene and write its result folder.
#pragma once

#include <iosfwd>

#include "apps/run_options.hpp"

namespace ashlar {

/// Wall time between checkpoints, s: what a run that is killed loses at most.
inline constexpr double checkpoint_interval = 60.0;

/// @param err faults and progress
/// @return exit status: 0 done; 1 the run failed, its last accepted state is saved; 2 bad input, nothing
/// written; 130 interrupted (SIGINT or SIGTERM), state saved.
/// @throws std::runtime_error with path and reason if a result cannot be written.
int run_command(const RunOptions& options, std::ostream& err);

}  // namespace ashlar

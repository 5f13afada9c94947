// `ashlar run`: simulate a scene and write its result folder.
#pragma once

#include "apps/run_options.hpp"

namespace ashlar {

/// @return exit status: 0 done; 1 the run failed, its last accepted state is saved; 2 bad input, nothing
/// written; 130 interrupted, state saved. Faults go to stderr.
int run_command(const RunOptions& options);

}  // namespace ashlar

// The runs of a sweep, each in a process of its own, some at a time. A run that has ended is kept; one that was stopped goes on.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "apps/run/run_command.hpp"

namespace ashlar {

struct SweepRun {
  RunOptions options;  ///< with a folder, different from those of the others
  std::string name;    ///< the settings that are varied, for messages
};

/// @param jobs at a time; 0: as many as there are processors. @param quiet no line for runs that end well
/// @return exit status: 0 all ended well; 1 some failed; 2 some were refused; 130 interrupted
/// @throws std::runtime_error with path and reason if files cannot be written, or processes cannot be made
[[nodiscard]] int run_sweep(std::vector<SweepRun> runs, int jobs, bool quiet, std::ostream& err);

}  // namespace ashlar

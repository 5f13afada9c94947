// The runs of a sweep, each in a process of its own, several at a time. Finished runs are kept; interrupted ones
// continue.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "apps/program/run/run_command.hpp"

namespace ashlar {

struct SweepRun {
  RunOptions options;  ///< with different folders
  std::string name;    ///< the varied settings, for messages
};

/// @param jobs at a time; 0: as many as there are processors. @param quiet no line for runs that end well
/// @return exit status: 0 all ended well; 1 some failed; 2 some were refused; 130 interrupted
/// @throws std::runtime_error with path and reason if files cannot be written, or processes cannot be created
[[nodiscard]] int run_sweep(std::vector<SweepRun> runs, int jobs, bool quiet, std::ostream& err);

}  // namespace ashlar

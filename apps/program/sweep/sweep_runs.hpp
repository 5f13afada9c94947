// The runs of a sweep, each in a process of its own, several at a time. Finished runs are kept; interrupted ones
// continue.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/program/run/run_command.hpp"

namespace ashlar {

struct SweepRun {
  RunOptions options;  ///< with different folders
  std::string name;    ///< the varied settings, for messages
};

/// True if the results in the folder of a run that was ended before the end of its scene are all that is asked for.
using SufficientResults = std::function<bool(const std::filesystem::path& folder)>;

/// One variant: kept, continued, or run. Called in a process of its own. @param suffice null: no such results
/// @return exit status of the run
[[nodiscard]] int run_variant(RunOptions run, std::ostream& log, const SufficientResults& suffice = nullptr);

/// Reason from a log for replacing results; empty: they were kept, or there were none.
[[nodiscard]] std::string reason_for_another_run(const std::filesystem::path& log);

/// The log of a run, beside its folder.
[[nodiscard]] std::filesystem::path log_of(const RunOptions& run);

/// @param jobs at a time; 0: as many as there are processors. @param quiet no line for runs that end well
/// @return exit status: 0 all ended well; 1 some failed; 2 some were refused; 130 interrupted
/// @throws std::runtime_error with path and reason if files cannot be written, or processes cannot be created
[[nodiscard]] int run_sweep(const std::vector<SweepRun>& runs, int jobs, bool quiet, std::ostream& err);

}  // namespace ashlar

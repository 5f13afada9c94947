// Runs in processes of their own, several at a time, each with a log: of a sweep, of a fragility analysis.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace ashlar {

struct ProcessRun {
  std::string name;           ///< for messages
  std::filesystem::path log;  ///< a plain file that is emptied first
  /// Called in the process, with the log. @return its exit status. Exceptions are written to the log
  std::function<int(std::ostream& log)> run;
  /// Called here once it has ended: a remark for the line about it; empty: none
  std::function<std::string()> remark;
};

struct ProcessOptions {
  int jobs = 0;        ///< at a time; 0: as many as there are processors
  bool quiet = false;  ///< no line for runs that end well
  bool tells_time =
      false;  ///< lines have the time left, from the mean of the runs that took longer than a moment
};

/// A line on err for each run that has ended.
/// @return exit status: 0 all ended well; 1 some failed; 2 some were refused; 130 interrupted
/// @throws std::runtime_error with path and reason if processes cannot be created
[[nodiscard]] int run_processes(std::vector<ProcessRun> runs, const ProcessOptions& options,
                                std::ostream& err);

/// "3 h 20 min", "12 min", "40 s": a time to wait, to the nearest of two units. @param seconds >= 0
[[nodiscard]] std::string waiting_time(double seconds);

}  // namespace ashlar

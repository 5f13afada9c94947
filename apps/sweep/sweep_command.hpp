// `ashlar sweep`: runs of a scene whose keys take several values each, side by side, and a table of what came of them.
//
// Each variant runs in a process of its own, as `ashlar run SCENE --set key=value ...` would, into a folder beside the
// table; its log is beside that folder. A sweep that is run again keeps what has ended, goes on with what has not, and
// adds what is new.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/command_line.hpp"
#include "apps/sweep/variants.hpp"

namespace ashlar {

struct SweepOptions {
  std::filesystem::path scene;                 ///< a file
  std::vector<std::string> varied;             ///< "key=a,b,c" or "key=normal(32, 2)" each
  Samples samples;                             ///< of values that are drawn
  std::vector<std::string> overrides;          ///< "key.path=value" each, for all variants
  std::vector<std::string> values;             ///< columns wanted, see sweep_table.hpp; empty: the usual ones
  std::optional<std::filesystem::path> table;  ///< empty: the scene's name + ".sweep.csv"
  std::optional<std::filesystem::path>
      picture;  ///< .svg or .png: the first value of the table against the keys, or its histogram over samples
  int jobs = 0;        ///< runs at a time; 0: as many as there are processors
  bool force = false;  ///< replace results of other scenes, and a strange table
  bool quiet = false;  ///< no line per run on stderr
};

/// Runs what is not there yet and writes the table, whatever became of the runs.
/// @param out the table as it was written. @param err progress and faults
/// @return exit status: 0 all runs ended well; 1 some failed; 2 bad input, or some were refused; 130 interrupted:
/// what has not ended goes on when the same command is run again
/// @throws std::runtime_error with path and reason if files cannot be written, or processes cannot be made
int sweep_command(const SweepOptions& options, std::ostream& out, std::ostream& err);

/// Declares `ashlar sweep`.
void declare_sweep_command(CLI::App& program, CommandContext& context);

}  // namespace ashlar

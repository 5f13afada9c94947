// `ashlar sweep`: parallel runs of a scene with several values of its keys, and a table of their results.
//
// Each variant runs in a process of its own, as `ashlar run SCENE --set key=value ...` would, into a folder beside
// the table, with its log beside that folder. A repeated sweep keeps finished runs, continues unfinished ones, and
// adds new ones.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"
#include "apps/program/sweep/variants.hpp"

namespace ashlar {

struct SweepOptions {
  std::filesystem::path scene;                 ///< a file
  std::vector<std::string> varied;             ///< "key=a,b,c" or "key=normal(32, 2)" each
  Samples samples;                             ///< of random values
  std::vector<std::string> overrides;          ///< "key.path=value" each, for all variants
  std::vector<std::string> values;             ///< columns, see sweep_table.hpp; empty: default ones
  std::optional<std::filesystem::path> table;  ///< empty: the scene's name + ".sweep.csv"
  std::optional<std::filesystem::path>
      picture;  ///< .svg or .png: the first value of the table against the keys, or its histogram over samples
  int jobs = 0;        ///< runs at a time; 0: as many as there are processors
  bool force = false;  ///< replace results of other scenes, and another table
  bool quiet = false;  ///< no line per run on stderr
};

/// Executes missing runs and writes the table, independent of the status of runs.
/// @param out the table as written. @param err progress and faults
/// @return exit status: 0 all runs ended well; 1 some failed; 2 bad input, or some were refused; 130 interrupted:
/// unfinished runs continue when the same command is run again
/// @throws std::runtime_error with path and reason if files cannot be written, or processes cannot be created
int sweep_command(const SweepOptions& options, std::ostream& out, std::ostream& err);

/// Declares `ashlar sweep`.
void declare_sweep_command(CLI::App& program, CommandContext& context);

}  // namespace ashlar

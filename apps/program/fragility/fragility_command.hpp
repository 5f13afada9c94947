// `ashlar fragility`: how likely a limit is exceeded at an intensity of an earthquake.
//
// Runs a scene with each record of a folder, times each scale, in processes as `ashlar sweep`, and fits a fragility curve
// to each limit. A repeated command keeps runs whose outcome is certain, continues others, and adds new ones.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"
#include "apps/program/sweep/variants.hpp"

namespace ashlar {

struct FragilityOptions {
  std::filesystem::path scene;               ///< a file
  std::filesystem::path records;             ///< a folder
  std::string scales;                        ///< "0.1:0.1:1.0" or "0.1,0.2,0.5"
  std::vector<std::string> limits;           ///< limit.hpp; empty: collapse
  std::string intensity = "pga";             ///< intensity.hpp
  std::vector<std::string> varied;           ///< "key=normal(32, 2)" each
  Samples samples;                           ///< of these
  double confidence = 95.0;                  ///< percent
  double after = 5.0;                        ///< s after the record
  std::vector<std::string> overrides;        ///< "key.path=value" each, of all runs
  std::optional<std::filesystem::path> out;  ///< folder; empty: the scene's name + ".fragility"
  int jobs = 0;                              ///< runs at a time; 0: as many as there are processors
  bool frames = false;                       ///< as the scene asks
  bool force = false;                        ///< replace results of other scenes
  bool quiet = false;                        ///< no line per run on stderr
};

/// Scales: "FIRST:STEP:LAST", with LAST if the step comes to within a millionth of itself, or numbers between commas.
/// @return increasing, each > 0. @throws std::invalid_argument with the fault and the requirement
[[nodiscard]] std::vector<double> parse_scales(const std::string& text);

/// Executes missing runs and writes fragility.csv, fragility.json, fragility.svg and ida.svg, the pictures by scripts
/// beside them; independent of the status of runs. @param out the fits in words. @param err progress and faults
/// @return exit status: 0 all runs ended well; 1 some failed; 2 bad input, or some were refused; 130 interrupted:
/// unfinished runs continue when the same command is run again
/// @throws std::runtime_error with path and reason if files cannot be written, or processes cannot be created
int fragility_command(const FragilityOptions& options, std::ostream& out, std::ostream& err);

/// Declares `ashlar fragility`.
void declare_fragility_command(CLI::App& program, CommandContext& context);

}  // namespace ashlar

// Options of `ashlar run` on its command line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"

namespace ashlar {

class RunObserver;  // run_observer.hpp

/// Limits of a scene that somebody else has written.
struct SceneLimits {
  std::uint64_t blocks = 5000;
  double memory = 4e9;  ///< bytes that a run is estimated to need
};

struct RunOptions {
  std::filesystem::path scene;  ///< "-": standard input
  /// Text of the scene in place of the file's content; paths in it are still relative to the file's folder
  std::optional<std::string> text = {};
  std::optional<std::filesystem::path>
      out;                             ///< result folder; empty: the scene's name + ".out" ("stdin.out")
  std::vector<std::string> overrides;  ///< "key.path=value" each, in order
  bool resume = false;                 ///< continue from the checkpoint in the result folder
  bool force = false;                  ///< replace existing results; not with resume
  std::optional<double>
      checkpoint;      ///< s between checkpoints, >= 0; empty: growing to a minute, at most 3 % of the time
  int threads = 0;     ///< >= 1; 0: not given
  bool quiet = false;  ///< no progress output on stderr
  bool view = false;   ///< write view.html at the end
  bool all_errors = false;                    ///< errors of the orders of all blocks in the summary
  std::optional<std::string> explained_pair;  ///< "a,b": blocks whose contacts are explained at the end
  /// Attached last, with the rows of all steps in memory; null: none. If it ends the run, that is interrupted
  std::shared_ptr<RunObserver> observer = {};
  std::optional<SceneLimits> limits = {};  ///< a scene above them is an error
};

/// Declares `ashlar run`; it calls run_command (run_command.hpp).
void declare_run_command(CLI::App& program, CommandContext& context);

}  // namespace ashlar

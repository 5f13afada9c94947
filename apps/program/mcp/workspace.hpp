// Folder, limits and runs of a server, which its tools share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/program/mcp/shared_folder.hpp"
#include "apps/program/mcp/work_process.hpp"
#include "apps/program/run/run_options.hpp"
#include "apps/results/folder/scratch_folder.hpp"

namespace ashlar {

/// Limits of a server.
struct ServerLimits {
  int runs = 2;          ///< at a time
  SceneLimits scene;     ///< of scenes that are run
  double hours = 24.0;   ///< of a run, which is then asked to end
  double seconds = 600;  ///< of any other call, which is then ended
};

/// A run that a client has started.
struct ServedRun {
  std::string name;              ///< "run-1"
  std::filesystem::path scene;   ///< relative to the server's folder, as `folder`
  std::filesystem::path folder;  ///< of its results
  std::unique_ptr<WorkProcess> process;
  bool asked_to_end = false;
  bool too_long = false;  ///< asked to end by the limit of hours
};

class Workspace {
 public:
  /// @throws std::filesystem::filesystem_error if there is no such folder
  Workspace(const std::filesystem::path& folder, const ServerLimits& limits);

  [[nodiscard]] const SharedFolder& folder() const { return folder_; }
  [[nodiscard]] const ServerLimits& limits() const { return limits_; }

  /// A new name in a private folder, for files of one call.
  [[nodiscard]] std::filesystem::path scratch_name();

  /// Folders that commands may read: the server's and the private one.
  [[nodiscard]] std::vector<std::filesystem::path> readable() const {
    return {folder_.root(), scratch_.path()};
  }

  /// Starts a run. @param options their paths are those of SharedFolder. Refused: a folder that another run of this server
  /// writes; one that holds results, unless they are continued or replaced; more runs than allowed. @throws ToolRefusal
  ServedRun& start(RunOptions options);
  /// All runs, in the order of their starts.
  [[nodiscard]] const std::vector<std::unique_ptr<ServedRun>>& runs() const { return runs_; }
  /// @throws ToolRefusal if there is no run of that name
  [[nodiscard]] ServedRun& run_of(const std::string& name);
  /// Asks runs to end that have reached the limit of hours.
  void look_after_runs();
  /// Asks all runs to end, which saves their states. @return true if none works any more
  [[nodiscard]] bool end_runs();

 private:
  void refuse_in_use(const RunOptions& options) const;

  SharedFolder folder_;
  ServerLimits limits_;
  ScratchFolder scratch_;
  std::vector<std::unique_ptr<ServedRun>> runs_;
  int names_ = 0;
};

}  // namespace ashlar

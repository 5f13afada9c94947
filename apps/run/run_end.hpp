// How a run and its present stage have ended.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "apps/results/folder/run_status.hpp"

namespace ashlar {

struct RunEnd {
  std::optional<RunStatus> status;         ///< of the run; empty until it has ended
  RunStatus stage = RunStatus::completed;  ///< of the present stage, at its end
  std::string message;                     ///< Run::message()
  std::string unsaved;                     ///< Run::unsaved()

  /// Ends the run and its stage.
  void end(RunStatus both) { status = stage = both; }
  void fail(std::string reason) {
    end(RunStatus::failed);
    message = std::move(reason);
  }
};

}  // namespace ashlar

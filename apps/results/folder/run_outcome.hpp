// Data of a run besides its simulation: status, times, finished stages.
#pragma once

#include <string>
#include <vector>

#include "apps/results/folder/run_status.hpp"
#include "apps/results/frames/largest_values.hpp"
#include "solver/shared/gathered_run.hpp"

namespace ashlar {

/// Wall time of the parts of a run, s; of a resumed one including earlier sessions.
struct RunSeconds {
  double total = 0.0;
  double setup = 0.0;
  double output = 0.0;
};

/// A finished stage of a run.
struct FinishedStage {
  std::string status;   ///< as in summary.json
  std::string message;  ///< empty: no message
  int steps;            ///< of the run, at its end
  double time;          ///< s, at its end
};

/// Data of a run at its end that the simulation does not have.
struct RunOutcome {
  RunStatus status;
  std::string message;  ///< message about the end; empty: none
  RunSeconds seconds;
  int frames;
  LargestValues largest;
  std::vector<FinishedStage> stages;  ///< those that have begun, including the present one; empty: not
                                      ///< written
  std::vector<RankWork> ranks = {};   ///< of processes that shared the run, by rank; empty: there were none
};

}  // namespace ashlar

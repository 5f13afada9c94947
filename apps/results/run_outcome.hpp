// What a run knows of itself beside its simulation: how it went, how long it took, which stages it has been through.
#pragma once

#include <string>
#include <vector>

#include "apps/results/largest_values.hpp"
#include "apps/results/run_status.hpp"

namespace ashlar {

/// Wall time of the parts of a run, s; of a resumed one with what came before.
struct RunSeconds {
  double total = 0.0;
  double setup = 0.0;
  double output = 0.0;
};

/// A stage of a run that has come to its end.
struct FinishedStage {
  std::string status;   ///< as in summary.json
  std::string message;  ///< empty: nothing to tell
  int steps;            ///< of the run, at its end
  double time;          ///< s, at its end
};

/// What only the run itself knows of its end.
struct RunOutcome {
  RunStatus status;
  std::string message;  ///< what has to be told of how it ended; empty: nothing
  RunSeconds seconds;
  int frames;
  LargestValues largest;
  std::vector<FinishedStage> stages;  ///< those that have begun, with the present one; none: not written
};

}  // namespace ashlar

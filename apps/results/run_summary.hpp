// summary.json: what a run did, what it skipped, how long it took and how well its energies add up.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/results/largest_values.hpp"
#include "apps/results/run_status.hpp"
#include "apps/scene/build_simulation.hpp"

namespace ashlar {

/// Wall time of the parts of a run, s; of a resumed one with what came before.
struct RunSeconds {
  double total = 0.0;
  double setup = 0.0;
  double output = 0.0;
};

/// What only the run itself knows of its end.
struct RunOutcome {
  RunStatus status;
  std::string message;  ///< what has to be told of how it ended; empty: nothing
  RunSeconds seconds;
  int frames;
  LargestValues largest;
};

/// @param scene of the whole run
[[nodiscard]] nlohmann::ordered_json run_summary(const Scene& scene, const BuiltSimulation& built,
                                                 const RunOutcome& outcome);

/// Joints that have lost their strength since the start of the run.
struct BrokenJoints {
  int pairs = 0;         ///< of blocks, that have lost any
  double area = 0.0;     ///< m^2
  double of_area = 0.0;  ///< m^2, of all joints that had strength to lose
};
[[nodiscard]] BrokenJoints broken_joints(const Simulation& simulation);

}  // namespace ashlar

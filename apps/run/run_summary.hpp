// summary.json: what a run did, what it skipped, how long it took and how well its energies add up.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/results/largest_values.hpp"
#include "apps/run/build_simulation.hpp"

namespace ashlar {

/// How a run ended, as `status` in summary.json.
enum class RunStatus {
  completed,      ///< "completed": a dynamic run reached its end time
  failed,         ///< "failed": a step could not be taken
  interrupted,    ///< "interrupted"
  equilibrium,    ///< "equilibrium": a static analysis found it
  moving,         ///< "moving": a static analysis found that there is none near: blocks move
  not_converged,  ///< "not converged": a static analysis found neither
};
[[nodiscard]] std::string to_string(RunStatus status);

/// Wall time of the parts of a run, s; of a resumed one with what came before.
struct RunSeconds {
  double total = 0.0;
  double setup = 0.0;
  double output = 0.0;
};

/// A block that a static analysis has taken far.
struct DisplacedBlock {
  int block;
  double distance;  ///< root mean square over the block from where it was placed, m
};
/// Blocks farther than a tenth of their size from where they were placed, those on supports that move left
/// out: what they rest in is not what was built.
[[nodiscard]] std::vector<DisplacedBlock> displaced_blocks(const Simulation& simulation);

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

// What `ashlar run` tells its user: numbers that were chosen, how a run ended and why, doubts about results.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "apps/results/run_summary.hpp"
#include "apps/scene/build_simulation.hpp"

namespace ashlar {

/// How a run ended, in words.
struct RunEnd {
  RunStatus status = RunStatus::failed;
  std::string message;  ///< why it failed or where it was interrupted, or what moves
  std::string unsaved;  ///< why the state that it ended in is not saved; empty: it is
};

/// "; changed: KEY (was A, is B), mesh FILE has changed, ..." from the summary of the run before in a result folder; empty
/// if it has none or says nothing else.
[[nodiscard]] std::string changes_since(const std::filesystem::path& folder, const Scene& scene,
                                        const SceneIdentity& identity);

/// Numbers that the program chose, and blocks that initial_state left as placed.
void tell_choices(const BuiltSimulation& built, std::ostream& err);

/// Nothing of a run that was completed. @param quiet only errors and interrupts
void tell_end(const RunEnd& end, const std::filesystem::path& folder, bool quiet, std::ostream& err);

/// The largest displacement and stresses, and joints that broke: one line.
void tell_answers(const Simulation& simulation, const LargestValues& largest, std::ostream& err);

/// Blocks that are farther in each other than contact that does not give way would be.
void warn_of_depth(const Simulation& simulation, std::ostream& err);

/// Multipliers stop what lands by impulses without friction, which the next steps make up for where blocks
/// stay together: warns where sliding blocks had another friction than Coulomb's.
void warn_of_friction(const Simulation& simulation, std::ostream& err);

/// Warns where joints that dilate slid without touching, and so without dilation.
void warn_of_hops(const Simulation& simulation, std::ostream& err);

}  // namespace ashlar

// Messages of `ashlar run`: automatic values, end of a run and its reason, warnings about results.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "apps/results/folder/run_summary.hpp"
#include "apps/scene/build/build_simulation.hpp"

namespace ashlar {

/// End of a run as text.
struct RunEnd {
  RunStatus status = RunStatus::failed;
  std::string message;  ///< reason of a failure, place of an interrupt, or moving blocks
  std::string unsaved;  ///< reason why the final state is not saved; empty: it is saved
};

/// "; changed: KEY (was A, is B), mesh FILE has changed, ..." from the summary of the earlier run in a result folder;
/// empty without a summary or differences.
[[nodiscard]] std::string changes_since(const std::filesystem::path& folder, const Scene& scene,
                                        const SceneIdentity& identity);

/// Prints automatic values, and blocks that initial_state left as placed.
void tell_choices(const BuiltSimulation& built, std::ostream& err);

/// Prints how a run ended; nothing for a completed one. @param quiet only errors and interrupts
void tell_end(const RunEnd& end, const std::filesystem::path& folder, bool quiet, std::ostream& err);

/// Prints the largest displacement and stresses, and failed joints: one line.
void tell_answers(const Simulation& simulation, const LargestValues& largest, std::ostream& err);

/// Warns of blocks that penetrate deeper than rigid contact would allow.
void warn_of_depth(const Simulation& simulation, std::ostream& err);

/// Warns of sliding blocks whose friction differed from Coulomb's law: multipliers stop impacts by impulses without
/// friction, which the next steps make up for only if blocks stay in contact.
void warn_of_friction(const Simulation& simulation, std::ostream& err);

/// Warns of dilating joints that slid without contact, and so without dilation.
void warn_of_hops(const Simulation& simulation, std::ostream& err);

}  // namespace ashlar

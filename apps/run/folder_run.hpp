// A run into a result folder, from its first step, or from a checkpoint, to its end: one stage after the other.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/checkpoint_schedule.hpp"
#include "apps/run/factor_search.hpp"
#include "apps/run/progress.hpp"
#include "apps/run/run_files.hpp"
#include "apps/run/run_messages.hpp"

namespace ashlar {

/// What a run is taken on with.
struct RunManner {
  int threads = 1;
  std::optional<double> checkpoint_interval;  ///< s; empty: growing, see CheckpointSchedule
  bool quiet = false;                         ///< no progress
};

/// The simulation of a stage. @throws std::runtime_error if its blocks cannot be built
[[nodiscard]] BuiltSimulation built_or_thrown(const LoadedScene& stage, int threads);

class FolderRun {
 public:
  /// @param loaded the whole scene; outlives this, as does the claim
  /// @param built of the stage that the run begins or goes on in
  /// @param earlier the checkpoint that it goes on from, or null
  /// @param bracket of a search for a factor, whose motion this run shows
  /// @param start seconds_now() when the program began
  /// @throws std::runtime_error if the folder cannot be written
  FolderRun(const LoadedScene& loaded, const RunManner& manner, BuiltSimulation built,
            const FolderClaim& claim, const RunCheckpoint* earlier, std::optional<FactorBracket> bracket,
            double start);

  /// Steps until the end, an interrupt or a failure; the state and a summary are saved. @param err progress
  RunEnd go(std::ostream& err);

  [[nodiscard]] const Simulation& simulation() const { return built_.simulation; }
  [[nodiscard]] LargestValues largest() const { return files_.tables().largest(built_.simulation); }

 private:
  RunStatus go_through_stage(std::ostream& err);
  [[nodiscard]] std::string end_of_stage(RunStatus status) const;
  [[nodiscard]] FinishedStage finished(RunStatus status) const;
  void begin_next_stage(RunStatus status);
  RunStatus take_steps(ProgressLine& progress);
  RunStatus find_equilibrium(ProgressLine& progress);
  RunStatus audited();
  RunStatus answered(RunStatus status);
  RunStatus failed_in_step(const std::exception& error);
  RunStatus interrupted_here();
  void record_step(CheckpointSchedule& schedule, ProgressLine& progress);
  void save() { files_.save(built_.simulation.snapshot(), stages_); }
  RunStatus saved_after(const std::exception& error);
  RunStatus summarised(RunStatus status);
  [[nodiscard]] nlohmann::ordered_json summary_of(RunStatus status) const;

  const LoadedScene& loaded_;
  RunManner manner_;
  std::vector<FinishedStage> stages_;  ///< those before the present one
  Scene scene_;                        ///< of the present stage
  std::optional<FactorBracket> bracket_;
  BuiltSimulation built_;
  RunFiles files_;
  std::string message_;  ///< see RunEnd
  std::string unsaved_;
};

}  // namespace ashlar

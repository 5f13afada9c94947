// A run into a result folder from its first step, or from a checkpoint, to its end, stage by stage.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/checkpoint_schedule.hpp"
#include "apps/run/factor_search.hpp"
#include "apps/run/limit_run.hpp"
#include "apps/run/progress.hpp"
#include "apps/run/run_files.hpp"
#include "apps/run/run_messages.hpp"
#include "apps/run/thrust_run.hpp"

namespace ashlar {

/// Options of a run.
struct RunManner {
  int threads = 1;
  std::optional<double> checkpoint_interval;  ///< s; empty: growing, see CheckpointSchedule
  bool quiet = false;                         ///< no progress output
};

/// Initial data of a run.
struct RunStart {
  BuiltSimulation built;                   ///< of the stage in which the run begins or continues
  const RunCheckpoint* earlier = nullptr;  ///< the checkpoint that it continues from; null: none
  SceneIdentity identity;                  ///< of the whole scene
  std::optional<FactorBracket> bracket;    ///< of a search for a factor, whose motion is shown
  std::optional<LimitFindings> limits;     ///< the same, by limit analysis
  std::optional<ThrustFindings> thrust;    ///< of an analysis of thrust
  double began = 0.0;                      ///< seconds_now() when the program began
};

/// The simulation of a stage. @throws std::runtime_error if its blocks cannot be built
[[nodiscard]] BuiltSimulation built_or_thrown(const LoadedScene& stage, int threads);

class FolderRun {
 public:
  /// @param loaded the whole scene; outlives this, as does the claim
  /// @throws std::runtime_error if the folder cannot be written
  FolderRun(const LoadedScene& loaded, const RunManner& manner, RunStart start, const FolderClaim& claim);

  /// Steps until the end, an interrupt or a failure. Saves the state and a summary. @param err progress
  /// @throws std::bad_alloc without memory, possibly within a step: the last checkpoint remains, and there is no
  /// summary, so that the run counts as unfinished
  RunEnd go(std::ostream& err);

  /// True if only the onset of motion is drawn.
  [[nodiscard]] bool drawn_only() const { return (limits_.has_value() && !bracket_) || thrust_.has_value(); }
  /// True if the folder has a checkpoint of this run.
  [[nodiscard]] bool saved() const { return saved_; }

  [[nodiscard]] const Simulation& simulation() const { return built_.simulation; }
  [[nodiscard]] LargestValues largest() const { return files_.tables().largest(built_.simulation); }

 private:
  RunStatus go_through_stage(std::ostream& err);
  [[nodiscard]] std::string end_of_stage(RunStatus status) const;
  [[nodiscard]] FinishedStage finished(RunStatus status) const;
  bool begin_next_stage(RunStatus status);
  RunStatus take_steps(ProgressLine& progress);
  RunStatus find_equilibrium(ProgressLine& progress);
  RunStatus show_limits(ProgressLine& progress);
  RunStatus show_thrust(ProgressLine& progress);
  RunStatus audited();
  RunStatus answered(RunStatus status);
  RunStatus failed_in_step(const std::exception& error);
  RunStatus interrupted_here();
  void record_step(CheckpointSchedule& schedule, ProgressLine& progress);
  void save();
  RunStatus saved_after(const std::exception& error);
  RunStatus summarised(RunStatus status);
  [[nodiscard]] nlohmann::ordered_json summary_of(RunStatus status) const;

  const LoadedScene& loaded_;
  RunManner manner_;
  std::vector<FinishedStage> stages_;  ///< those before the present one
  Scene scene_;                        ///< of the present stage
  std::optional<FactorBracket> bracket_;
  std::optional<LimitFindings> limits_;
  std::optional<ThrustFindings> thrust_;
  BuiltSimulation built_;
  ContactChanges changes_;  ///< of static iterations of the present stage
  RunFiles files_;
  bool saved_ = false;
  std::string message_;  ///< see RunEnd
  std::string unsaved_;
};

}  // namespace ashlar

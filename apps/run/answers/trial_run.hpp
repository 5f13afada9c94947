// A static analysis of a search for a factor, iteration by iteration, along the load path of limit analysis
// (solver/paths/load_path.hpp): blocks first come to rest under their first loads, for a factor of safety with ten times
// their strength, for a capacity without the multiplied loads, and from there under the factor.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/results/folder/contact_changes.hpp"
#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/run/answers/factor_search.hpp"
#include "apps/run/run_group.hpp"
#include "apps/scene/assemble/build_simulation.hpp"

namespace ashlar {

class TrialRun {
 public:
  /// Begins with the blocks as placed. If they cannot be built the trial has ended, inconclusive.
  /// @param scene must outlive this. @param group shares the trial: all members but plain values are collective
  TrialRun(const LoadedScene& scene, double factor, int threads, const RunGroup& group = {});

  /// Takes an iteration of a trial that has not ended. @return true if it goes on
  bool iterate();

  [[nodiscard]] double factor() const { return factor_; }
  [[nodiscard]] int iterations() const { return built_ ? built_->simulation.steps() : 0; }
  /// Empty until the trial has ended.
  [[nodiscard]] const std::optional<FactorTrial>& result() const { return result_; }
  /// Reason for an inconclusive result, on the first process; empty otherwise.
  [[nodiscard]] const std::string& reason() const { return reason_; }

  /// State between two iterations, for restore() of a trial of the same factor: simulation and changes of contacts. Of
  /// several processes the first one has it, and all restore it.
  [[nodiscard]] RunCheckpoint state() const;
  void restore(const RunCheckpoint& state);

 private:
  /// True if a block has gone further than allowed from the state at rest. Collective.
  [[nodiscard]] bool has_yielded() const;
  /// Goes on from the state at rest under the factor. @return false if blocks cannot be built
  bool leave_rest();

  const LoadedScene& scene_;
  int threads_;
  RunGroup group_;
  double factor_;
  double end_time_;         ///< s, of the loads
  bool at_factor_ = false;  ///< true: under the factor, false: under the first loads
  std::optional<BuiltSimulation> built_;
  ContactChanges changes_;
  std::optional<FactorTrial> result_;
  std::string reason_;
};

/// Starts a simulation of the scene under the factor from the state at rest of the first loads, if they have one. Collective.
void start_at_rest(const LoadedScene& scene, int threads, const RunGroup& group, Simulation& under_factor);

}  // namespace ashlar

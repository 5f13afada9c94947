#include "apps/run/trial_run.hpp"

#include "apps/run/factor_analysis.hpp"

namespace ashlar {

TrialRun::TrialRun(const LoadedScene& scene, double factor, int threads, const RunRanks* ranks)
    : factor_(factor), end_time_(scene.scene.analysis.end_time) {
  Diagnostics ignored;  // the same as without a factor
  built_ =
      build_simulation(scene, threads, ignored, nullptr, trial_factors(scene.scene.analysis, factor), ranks);
  if (built_)
    built_->simulation.gather_results();
  else
    result_ = FactorTrial{factor, TrialOutcome::unknown, 0};
}

bool TrialRun::iterate() {
  Simulation& simulation = built_->simulation;
  const StaticStatus status = attempted_step(simulation, end_time_);
  simulation.gather_results();
  if (status == StaticStatus::balancing) {
    changes_.note(simulation);
    return true;
  }
  result_ = FactorTrial{factor_, outcome_of(status, simulation), simulation.steps()};
  if (result_->outcome == TrialOutcome::unknown) reason_ = describe_unconverged(simulation, changes_);
  return false;
}

RunCheckpoint TrialRun::state() const {
  RunCheckpoint state;
  state.simulation = built_->simulation.snapshot();
  state.changes = changes_;
  return state;
}

void TrialRun::restore(const RunCheckpoint& state) {
  built_->simulation.restore(state.simulation);
  built_->simulation.gather_results();
  changes_ = state.changes;
}

}  // namespace ashlar

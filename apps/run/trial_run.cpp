#include "apps/run/trial_run.hpp"

#include "apps/run/factor_analysis.hpp"

namespace ashlar {

TrialRun::TrialRun(const LoadedScene& scene, double factor, int threads)
    : factor_(factor), end_time_(scene.scene.analysis.end_time) {
  Diagnostics ignored;  // the same as without a factor
  built_ = build_simulation(scene, threads, ignored, nullptr, trial_factors(scene.scene.analysis, factor));
  if (!built_) result_ = FactorTrial{factor, TrialOutcome::unknown, 0};
}

bool TrialRun::iterate() {
  Simulation& simulation = built_->simulation;
  const StaticStatus status = attempted_step(simulation, end_time_);
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
  changes_ = state.changes;
}

}  // namespace ashlar

#include "apps/run/answers/trial_run.hpp"

#include <utility>

#include "apps/run/answers/factor_analysis.hpp"
#include "solver/paths/load_path.hpp"
#include "solver/state/static_state.hpp"

namespace ashlar {

namespace {

/// Factors of the state at rest, from which the path begins.
TrialFactors first_factors(const SceneAnalysis& analysis) {
  constexpr double nothing_slides = 0.1, no_load = 0.0;
  return analysis.type == SceneAnalysis::Type::safety ? TrialFactors{nothing_slides, 1.0}
                                                      : TrialFactors{1.0, no_load};
}

std::optional<BuiltSimulation> built_under(const TrialFactors& factors, const LoadedScene& scene, int threads,
                                           const RunGroup& group) {
  Diagnostics ignored;  // the same as without a factor
  return build_simulation(scene, threads, ignored, nullptr, factors, group.ranks());
}

}  // namespace

TrialRun::TrialRun(const LoadedScene& scene, double factor, int threads, const RunGroup& group)
    : scene_(scene),
      threads_(threads),
      group_(group),
      factor_(factor),
      end_time_(scene.scene.analysis.end_time),
      built_(built_under(first_factors(scene.scene.analysis), scene, threads, group)) {
  if (built_)
    built_->simulation.gather_results();
  else
    result_ = FactorTrial{factor, TrialOutcome::unknown, 0};
}

bool TrialRun::has_yielded() const {
  const Simulation& simulation = built_->simulation;
  // Where the load level began: a restored trial knows it too.
  const std::vector<Eigen::MatrixX3d> rest = simulation.snapshot().run.statics.level_start;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    if (block.fixed() || block.driven() || !simulation.system().owns(static_cast<int>(k))) continue;
    const Eigen::MatrixX3d& start = rest.empty() ? block.initial_state().position : rest[k];
    const double allowed =
        scene_.scene.analysis.allowed_displacement.value_or(allowed_displacement_share * block.size());
    if (mean_motion(block, simulation.states()[k].position - start) > allowed) return true;
  }
  return false;
}

bool TrialRun::leave_rest() {
  at_factor_ = true;
  std::optional<BuiltSimulation> next =
      built_under(trial_factors(scene_.scene.analysis, factor_), scene_, threads_, group_);
  if (!next) {
    result_ = FactorTrial{factor_, TrialOutcome::unknown, iterations()};
    return false;
  }
  next->simulation.start_stage(built_->simulation);
  built_ = std::move(next);
  built_->simulation.gather_results();
  changes_.forget();
  return true;
}

bool TrialRun::iterate() {
  Simulation& simulation = built_->simulation;
  const StaticStatus status = attempted_step(simulation, end_time_);
  simulation.gather_results();
  if (status == StaticStatus::balancing) {
    changes_.note(simulation);
    return true;
  }
  if (!at_factor_ && status == StaticStatus::equilibrium) return leave_rest();
  result_ = FactorTrial{factor_, outcome_of(status, simulation), simulation.steps()};
  if (group_.any(has_yielded()) && result_->outcome == TrialOutcome::stands)
    result_->outcome = TrialOutcome::moves;
  if (result_->outcome == TrialOutcome::unknown) reason_ = describe_unconverged(simulation, changes_);
  return false;
}

RunCheckpoint TrialRun::state() const {
  RunCheckpoint state;
  state.simulation = built_->simulation.snapshot();
  state.changes = changes_;
  // The state at rest is a stage before that under the factor.
  if (at_factor_) state.stages.emplace_back();
  return state;
}

void TrialRun::restore(const RunCheckpoint& state) {
  if (!state.stages.empty() && !at_factor_) {
    built_ = built_under(trial_factors(scene_.scene.analysis, factor_), scene_, threads_, group_);
    at_factor_ = true;
  }
  built_->simulation.restore(state.simulation);
  built_->simulation.gather_results();
  changes_ = state.changes;
}

void start_at_rest(const LoadedScene& scene, int threads, const RunGroup& group, Simulation& under_factor) {
  std::optional<BuiltSimulation> rest =
      built_under(first_factors(scene.scene.analysis), scene, threads, group);
  if (!rest) return;
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing)
    status = attempted_step(rest->simulation, scene.scene.analysis.end_time);
  rest->simulation.gather_results();
  if (status == StaticStatus::equilibrium) under_factor.start_stage(rest->simulation);
}

}  // namespace ashlar

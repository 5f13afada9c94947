#include "apps/run/run.hpp"

#include <fmt/format.h>

#include <new>
#include <stdexcept>

#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/run/accuracy_choice.hpp"
#include "apps/run/answers/answer_summary.hpp"
#include "apps/run/answers/factor_analysis.hpp"
#include "apps/run/answers/undecided.hpp"
#include "apps/run/run_findings.hpp"
#include "apps/run/run_history.hpp"
#include "apps/run/run_preparation.hpp"
#include "apps/run/run_record.hpp"
#include "apps/run/run_setup.hpp"
#include "apps/run/run_stages.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

/// @throws std::invalid_argument
BuiltSimulation first_stage(const std::shared_ptr<const LoadedScene>& scene, int threads,
                            const RunGroup& group) {
  if (threads < 1) throw std::invalid_argument(fmt::format("threads is {}, at least 1 is needed", threads));
  Diagnostics diagnostics;
  std::optional<BuiltSimulation> built =
      build_first_stage(stage_scene(scene, 0), threads, diagnostics, nullptr, group);
  for (const Diagnostic& fault : diagnostics.sorted())
    if (fault.severity == Severity::error) throw std::invalid_argument(to_string(fault));
  return std::move(*built);
}

bool is_done(RunStatus status) {
  return status == RunStatus::completed || status == RunStatus::equilibrium;
}

bool moves_in_time(const Scene& scene) {
  return scene.analysis.type == SceneAnalysis::Type::dynamic;
}

std::vector<Measure> written_measures(const Scene& whole, const Simulation& simulation,
                                      const RunGroup& group) {
  return group.first() ? measures_of(whole, simulation.blocks()) : std::vector<Measure>();
}

}  // namespace

Run::Run(std::shared_ptr<const LoadedScene> scene, int threads) : Run(scene, RunManner{.threads = threads}) {}

Run::Run(const std::shared_ptr<const LoadedScene>& scene, const RunManner& manner)
    : Run(scene, first_stage(scene, manner.threads, manner.ranks), manner) {}

Run::Run(std::shared_ptr<const LoadedScene> scene, BuiltSimulation built, const RunManner& manner)
    : stages_(std::make_unique<RunStages>(std::move(scene), std::move(built), manner.threads, manner.ranks)),
      preparation_(std::make_unique<RunPreparation>()),
      history_(std::make_unique<RunHistory>(written_measures(whole(), simulation(), stages_->group()),
                                            manner.keeps_history)),
      record_(std::make_unique<RunRecord>(stages_->group())),
      findings_(std::make_unique<RunFindings>(stages_->group(), manner.all_errors)),
      points_(std::make_unique<const BlockPoints>()) {
  clock_.add_since(manner.began);
}

Run::~Run() = default;
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;

void Run::begin() {
  const RunClock::Call call(clock_);
  while (prepares() && !end_.status) prepare();
}

bool Run::step() {
  if (end_.status && end_.status != RunStatus::failed) return false;
  if (!end_.status) {
    const RunClock::Call call(clock_);
    if (prepares()) prepare();
    if (!prepares() && !end_.status) advance();
  }
  if (end_.status == RunStatus::failed) throw std::runtime_error(end_.message);
  return !end_.status;
}

/// True until the run has begun.
bool Run::prepares() const {
  return preparation_->next() != RunPreparation::Next::nothing;
}

void Run::prepare() {
  preparation_->advance(*stages_, *record_, end_);
  if (!end_.status && preparation_->next() == RunPreparation::Next::begin) start_record();
}

void Run::start_record() {
  if (stage() == 1 && preparation_->checkpoint() == nullptr && history_->keeps_rows() &&
      whole().stage.front().reset_displacement)
    stages_->reset_displacement(history_->measures());
  history_->share_needs(stages_->group());
  stages_->gather();
  record_->begin(*this);
  preparation_->finish();
  history_->add(simulation(), place(), stage());
  clock_.note_setup();
}

void Run::advance() {
  const bool cracks_are_due = stages_->cracks_are_due();
  if (stages_->next() == RunStages::Next::next_stage && !begin_next_stage()) return;
  if (stages_->next() == RunStages::Next::first_step) {
    stages_->enter();
    if (!record_->tell(&RunObserver::stage_begins, *this, end_)) return;
  }
  if (answer().shows_states()) return show_state();
  if (cracks_are_due && !divide_cracked()) return;
  if (is_static(scene().analysis)) return take_iteration();
  take_step();
}

/// @return false if it cannot begin: the run has failed at the end of the last stage
bool Run::begin_next_stage() {
  if (auto fault = stages_->begin_next(stage_at_end(end_.stage))) {
    end_.message = std::move(*fault);
    end(RunStatus::failed);
    return false;
  }
  findings_->begin_stage();
  end_.message.clear();
  stages_->gather();
  if (history_->keeps_rows() && whole().stage[static_cast<std::size_t>(stage() - 1)].reset_displacement)
    stages_->reset_displacement(history_->measures());
  return true;
}

void Run::take_step() {
  Simulation& simulation = stages_->simulation();
  const double end_time = scene().analysis.end_time;
  if (!simulation.reached(end_time)) {
    if (!record_->may_continue()) return interrupt();
    const bool automatic = whole().analysis.automatic_step;
    StepStatus status = StepStatus::accepted;
    const bool attempted = attempt([&] {
      if (automatic)
        choose_step(simulation, motion_request(scene()), history_->goals(), preparation_->accuracy()->motion);
      status = simulation.step(end_time);
    });
    if (!attempted) return;
    if (status != StepStatus::accepted) {
      const Rejection& last = simulation.rejections().back();
      return end_stage(
          RunStatus::failed,
          fmt::format("step {} at t = {:.9g} s was rejected down to a time step of {:.3g} s: {}",
                      simulation.steps() + 1, simulation.time(), last.step, reason_of(last, simulation)));
    }
    if (automatic) note_step(simulation, preparation_->accuracy()->motion);
    if (!accept_step() || !divide_cracked()) return;
  }
  if (simulation.reached(end_time)) end_stage(RunStatus::completed, "");
}

void Run::take_iteration() {
  if (!record_->may_continue()) return interrupt();
  Simulation& simulation = stages_->simulation();
  const double end_time = stages_->end_of_loads();
  const int before = simulation.steps();
  StaticStatus found = StaticStatus::balancing;
  const bool attempted = attempt([&] {
    found = answer().bracket ? trial_step(simulation, end_time) : simulation.static_step(end_time);
  });
  if (!attempted) return;
  if (simulation.steps() > before || found != StaticStatus::balancing) stages_->gather();
  if (simulation.steps() > before) {
    findings_->note_iteration(simulation);
    if (!record_step()) return;
  }
  // The level continues with the parts.
  if (found != StaticStatus::moving && divide_cracked().value_or(true)) return;
  if (found == StaticStatus::equilibrium && !simulation.reached(scene().analysis.end_time)) return;
  switch (found) {
    case StaticStatus::balancing:
      return;
    case StaticStatus::equilibrium:
      return end_stage(RunStatus::equilibrium, describe_displaced(simulation));
    case StaticStatus::moving:
      return end_stage(RunStatus::moving, describe_motion(simulation));
    case StaticStatus::not_converged:
      return end_undecided();
  }
}

/// Shows the next state that the answer speaks of, as a step.
void Run::show_state() {
  Simulation& simulation = stages_->simulation();
  const std::vector<ShownState>& states = answer().states;
  const auto next = static_cast<std::size_t>(simulation.steps());
  if (next < states.size()) {
    show(states[next], scene().analysis.end_time, stages_->group(), simulation);
    if (!accept_step() || next + 1 < states.size()) return;
  }
  AnsweredEnd end = shown_end(answer(), scene().analysis, simulation);
  end_stage(end.status, std::move(end.message));
}

/// A step that cannot be taken, by a fault that no check of the scene detected, ends the stage in the state before it.
/// @return true if it was taken
bool Run::attempt(const std::function<void()>& step) {
  try {
    step();
    return true;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    if (stages_->group().shared()) throw;  // other processes may wait for this one
    end_stage(RunStatus::failed, fmt::format("step {} at t = {:.9g} s cannot be taken: {}",
                                             simulation().steps() + 1, simulation().time(), error.what()));
    return false;
  }
}

/// @return false if its results could not be written
bool Run::accept_step() {
  if (moves_in_time(scene())) findings_->note_step(simulation());
  const ResultFolder::Due due = record_->due(*this, history_->keeps_rows());
  stages_->gather(history_->needs(due), due);
  return record_step();
}

bool Run::record_step() {
  history_->add(simulation(), place(), stage());
  const Stopwatch watch(clock_.output());
  return record_->tell(&RunObserver::step_taken, *this, end_);
}

/// Divides blocks that have cracked.
/// @return true if there are any; empty: the run has failed
std::optional<bool> Run::divide_cracked() {
  bool any = false;
  if (!attempt([&] { any = stages_->divide_cracked(); })) return std::nullopt;
  if (!any) return false;
  history_->set_measures(written_measures(whole(), simulation(), stages_->group()));
  points_ = std::make_unique<const BlockPoints>();
  if (!record_->tell(&RunObserver::blocks_crack, *this, end_)) return std::nullopt;
  return true;
}

void Run::end_stage(RunStatus status, std::string message) {
  end_.stage = status;
  end_.message = std::move(message);
  if (moves_in_time(scene())) findings_->judge(simulation(), end_);
  stages_->gather();
  if (!record_->tell(&RunObserver::stage_stops, *this, end_)) return;
  if (status == RunStatus::completed && !answer().shows_states()) {
    if (const auto deep = stages_->simulation().audit()) {
      end_.stage = RunStatus::failed;
      end_.message = fmt::format("the run ended at t = {:.9g} s with blocks too deep in each other: {}",
                                 simulation().time(), description_of(*deep, simulation()));
    }
  }
  if (answer().bracket) {
    AnsweredEnd shown = bracket_end(answer(), scene().analysis, simulation(), {end_.stage, end_.message});
    end_.stage = shown.status;
    end_.message = std::move(shown.message);
  }
  const bool follows = stages_->end(is_done(end_.stage));
  if (!record_->tell(&RunObserver::stage_ends, *this, end_) || follows) return;
  end(end_.stage);
}

/// Ends a static analysis that has no result with the factors that bracket one.
void Run::end_undecided() {
  const std::string factors =
      answer().bracket ? ""
                       : undecided_factors(simulation(), scene().analysis.end_time, stages_->threads(),
                                           [this] { return record_->may_continue(); });
  end_stage(RunStatus::not_converged, describe_unconverged(simulation(), findings_->changes()) +
                                          (factors.empty() ? "" : "; by limit analysis, " + factors));
}

void Run::interrupt() {
  std::string message = fmt::format("interrupted after step {}", simulation().steps());
  if (!is_static(scene().analysis))
    message += fmt::format(" at t = {:.9g} s of {:.9g} s", simulation().time(), scene().analysis.end_time);
  end_stage(RunStatus::interrupted, std::move(message));
}

void Run::end(RunStatus status) {
  end_.end(status);
  findings_->conclude(whole(), scene(), simulation(), history_->goals(), end_);
  record_->tell_end(*this, end_);
}

}  // namespace ashlar

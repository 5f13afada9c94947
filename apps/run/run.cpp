#include "apps/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <stdexcept>

#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/system/this_process.hpp"
#include "apps/results/tables/contact_state.hpp"
#include "apps/run/accuracy_choice.hpp"
#include "apps/run/answers/answer_search.hpp"
#include "apps/run/answers/answer_summary.hpp"
#include "apps/run/answers/factor_analysis.hpp"
#include "apps/run/answers/limit_run.hpp"
#include "apps/run/answers/thrust_run.hpp"
#include "apps/run/answers/trial_run.hpp"
#include "apps/run/checkpoint_saver.hpp"
#include "apps/run/folder_recorder.hpp"
#include "apps/run/run_setup.hpp"
#include "apps/scene/assemble/initial_state.hpp"
#include "apps/scene/check/added_blocks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "geometry/index.hpp"
#include "solver/ranks/rank_messages.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

/// @throws std::invalid_argument
BuiltSimulation first_stage(const std::shared_ptr<const LoadedScene>& scene, int threads,
                            const RunRanks* ranks) {
  if (threads < 1) throw std::invalid_argument(fmt::format("threads is {}, at least 1 is needed", threads));
  Diagnostics diagnostics;
  std::optional<BuiltSimulation> built =
      build_first_stage(stage_scene(scene, 0), threads, diagnostics, nullptr, ranks);
  for (const Diagnostic& fault : diagnostics.sorted())
    if (fault.severity == Severity::error) throw std::invalid_argument(to_string(fault));
  return std::move(*built);
}

bool is_done(RunStatus status) {
  return status == RunStatus::completed || status == RunStatus::equilibrium;
}

}  // namespace

Run::Run(std::shared_ptr<const LoadedScene> scene, int threads) : Run(scene, RunManner{.threads = threads}) {}

Run::Run(const std::shared_ptr<const LoadedScene>& scene, const RunManner& manner)
    : Run(scene, first_stage(scene, manner.threads, manner.ranks), manner) {}

Run::Run(std::shared_ptr<const LoadedScene> scene, BuiltSimulation built, const RunManner& manner)
    : scene_(std::move(scene)),
      present_(built.scene ? built.scene : stage_scene(scene_, 0)),
      identity_(scene_identity(*scene_)),
      manner_(manner),
      built_(std::move(built)),
      measures_(manner.ranks == nullptr || manner.ranks->first()
                    ? measures_of(scene_->scene, built_.simulation.blocks())
                    : std::vector<Measure>()),
      points_(std::make_unique<const BlockPoints>()) {
  clock_.add_since(manner.began);
}

Run::~Run() = default;
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;

void Run::begin() {
  const RunClock::Call call(clock_);
  while (phase_ == Phase::preparing && !status_) prepare_piece();
}

bool Run::step() {
  if (status_ && status_ != RunStatus::failed) return false;
  if (!status_) {
    const RunClock::Call call(clock_);
    if (phase_ == Phase::preparing) prepare_piece();
    if (phase_ != Phase::preparing && !status_) advance();
  }
  if (status_ == RunStatus::failed) throw std::runtime_error(message_);
  return !status_;
}

void Run::prepare_piece() {
  if (!chosen_ && !choose_accuracy()) return;
  if (!started_) {
    if (!start_statically()) return;
    started_ = true;
    if (seeks_answer(whole().analysis)) {
      // A continued run has drawn the onset of motion already.
      if (earlier_) built_ = built_stage(present_, manner_.threads, manner_.ranks);
      search_ = std::make_unique<AnswerSearch>(scene_, identity_.scene, built_.simulation, manner_.threads,
                                               TrialStorage{claim_, keeps_trials_, checkpoint_interval_},
                                               manner_.ranks);
    }
  }
  if (search_ && search_piece()) return;
  if (status_) return;
  if (stage() == 1 && !earlier_ && manner_.keeps_history && whole().stage.front().reset_displacement)
    reset_displacement();
  if (shared()) row_needs_ = values_of_ranks(manner_.ranks->ranks, needs_of(measures_)).front();
  if (shared()) built_.simulation.gather_results({}, own_contact_counts(simulation()));
  const auto tell_beginning = [this] {
    observers_.tell(&RunObserver::run_begins, *this);
    if (shared() && saver_) saver_->run_begins(*this);
  };
  shared() ? do_on_all(manner_.ranks->ranks, tell_beginning) : tell_beginning();
  phase_ = Phase::stage_start;
  earlier_.reset();
  if (manner_.keeps_history) add_row();
  clock_.note_setup();
}

/// @return false if the run has ended with it
bool Run::choose_accuracy() {
  if (whole().analysis.accuracy && !earlier_) {
    std::optional<AccuracyState> choice;
    try {
      choice = choose_for_accuracy(*scene_, manner_.threads, [this] { return observers_.go_on(); });
      if (choice) {
        present_ = with_choice(*scene_, *choice);
        built_ = built_or_thrown(*present_, manner_.threads);
      }
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      message_ = fmt::format("no orders and steps could be chosen: {}", fault_text(error));
      status_ = RunStatus::failed;
      return false;
    }
    if (!choice) {
      message_ = "interrupted while orders and steps were chosen";
      status_ = RunStatus::interrupted;
      return false;
    }
    accuracy_ = std::move(*choice);
  }
  chosen_ = true;
  return true;
}

/// @return false if the run has ended with it
bool Run::start_statically() {
  if (!starts_from_statics(scene()) || earlier_) return true;
  const StaticStart start = start_in_statics(built_.simulation, [this] { return goes_on(); });
  message_ = start.message;
  if (start.end == StaticStart::End::failed) status_ = RunStatus::failed;
  if (start.end == StaticStart::End::interrupted) status_ = RunStatus::interrupted;
  return !status_;
}

/// @return true if the search goes on; it ends with the simulation that shows its answer, or is interrupted
bool Run::search_piece() {
  if (search_->advance(built_.simulation, observers_)) return true;
  answer_ = search_->answer();
  if (search_->interrupted()) {
    message_ = search_->message();
    answer_ = {};
    status_ = RunStatus::interrupted;
  } else if (answer_.bracket) {
    const SceneAnalysis& analysis = whole().analysis;
    const double shown = shown_factor(*answer_.bracket, search_of(analysis));
    built_ = built_stage(scene_, manner_.threads, manner_.ranks, trial_factors(analysis, shown));
    if (!earlier_) start_at_rest(*scene_, manner_.threads, manner_.ranks, built_.simulation);
  } else if (const auto factor = factor_of_states(answer_, whole().analysis)) {
    built_ = built_stage(scene_, manner_.threads, manner_.ranks, trial_factors(whole().analysis, *factor));
  }
  if (earlier_) built_.simulation.restore(earlier_->simulation);
  search_.reset();
  return false;
}

void Run::advance() {
  if (phase_ == Phase::stage_over && !begin_next_stage()) return;
  if (phase_ == Phase::stage_start) {
    phase_ = Phase::in_stage;
    if (!tell(&RunObserver::stage_begins)) return;
  }
  if (answer_.shows_states()) return show_state();
  if (is_static(scene().analysis)) return take_iteration();
  take_step();
}

/// @return false if it cannot begin: the run stays at the end of the last stage
bool Run::begin_next_stage() {
  const std::vector<bool> was_absent = built_.simulation.system().absent();
  const auto next = static_cast<std::size_t>(place_.stage);
  const std::string& name = whole().stage[next].name;
  try {
    const auto scene = stage_scene(scene_, next);
    BuiltSimulation stage = built_stage(scene, manner_.threads, manner_.ranks);
    stage.simulation.start_stage(built_.simulation);
    if (const auto overlap = overlap_of_added(stage.simulation, was_absent)) {
      message_ = fmt::format("stage {} cannot begin: {}", name, *overlap);
      end(RunStatus::failed);
      return false;
    }
    finished_.push_back(finished(stage_status_));
    place_.elapsed += built_.simulation.time();
    present_ = scene;
    built_ = std::move(stage);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    message_ = fmt::format("stage {} cannot begin: {}", name, fault_text(error));
    end(RunStatus::failed);
    return false;
  }
  ++place_.stage;
  changes_.forget();
  message_.clear();
  if (shared()) built_.simulation.gather_results({}, own_contact_counts(simulation()));
  if (manner_.keeps_history && whole().stage[next].reset_displacement) reset_displacement();
  phase_ = Phase::stage_start;
  return true;
}

void Run::reset_displacement() {
  place_.origin = origin_of(simulation(), measures_, drawn_blocks(simulation().blocks(), whole().output));
}

void Run::take_step() {
  Simulation& simulation = built_.simulation;
  const double end_time = scene().analysis.end_time;
  if (!simulation.reached(end_time)) {
    if (!goes_on()) return interrupt();
    StepStatus taken = StepStatus::accepted;
    try {
      if (whole().analysis.automatic_step)
        choose_step(simulation, motion_request(scene()), goals_of_measures(), accuracy_.motion);
      taken = simulation.step(end_time);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      if (shared()) throw;  // other ranks may wait for this one
      return fail_in_step(error);
    }
    if (taken != StepStatus::accepted) {
      const Rejection& last = simulation.rejections().back();
      return end_stage(
          RunStatus::failed,
          fmt::format("step {} at t = {:.9g} s was rejected down to a time step of {:.3g} s: {}",
                      simulation.steps() + 1, simulation.time(), last.step, reason_of(last, simulation)));
    }
    if (whole().analysis.automatic_step) note_step(simulation, accuracy_.motion);
    if (!accept_step()) return;
  }
  if (simulation.reached(end_time)) end_stage(RunStatus::completed, "");
}

void Run::take_iteration() {
  if (!goes_on()) return interrupt();
  Simulation& simulation = built_.simulation;
  const double end_time = scene().analysis.end_time;
  const int before = simulation.steps();
  StaticStatus found = StaticStatus::balancing;
  try {
    found = answer_.bracket ? trial_step(simulation, end_time) : simulation.static_step(end_time);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    if (shared()) throw;  // other ranks may wait for this one
    return fail_in_step(error);
  }
  if (shared() && (simulation.steps() > before || found != StaticStatus::balancing))
    simulation.gather_results({}, own_contact_counts(simulation));
  if (simulation.steps() > before) {
    changes_.note(simulation);
    if (!record_step()) return;
  }
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

/// @return false if its results could not be written
bool Run::accept_step() {
  if (moves_in_time()) falls_.note(simulation());
  if (shared()) gather_due();
  return record_step();
}

bool Run::record_step() {
  if (manner_.keeps_history) add_row();
  const Stopwatch watch(clock_.output());
  return tell(&RunObserver::step_taken);
}

void Run::end_stage(RunStatus status, std::string message) {
  stage_status_ = status;
  message_ = std::move(message);
  if (moves_in_time()) judge_motion();
  if (shared()) built_.simulation.gather_results({}, own_contact_counts(simulation()));
  if (!tell(&RunObserver::stage_stops)) return;
  if (status == RunStatus::completed && !answer_.shows_states()) {
    if (const auto deep = built_.simulation.audit()) {
      stage_status_ = RunStatus::failed;
      message_ = fmt::format("the run ended at t = {:.9g} s with blocks too deep in each other: {}",
                             simulation().time(), description_of(*deep, simulation()));
    }
  }
  if (answer_.bracket) {
    AnsweredEnd end = bracket_end(answer_, scene().analysis, simulation(), {stage_status_, message_});
    stage_status_ = end.status;
    message_ = std::move(end.message);
  }
  const bool follows =
      is_done(stage_status_) && static_cast<std::size_t>(place_.stage) < stage_count(whole());
  if (follows) phase_ = Phase::stage_over;
  if (!tell(&RunObserver::stage_ends) || follows) return;
  end(stage_status_);
}

/// Observers end in reverse order: the last state is saved before the summary tells the end.
void Run::end(RunStatus status) {
  status_ = stage_status_ = status;
  estimate_measures();
  if (shared()) rank_work_ = work_of_ranks(simulation(), {processor_time(), peak_memory_bytes()});
  for (auto observer = observers_.all().rbegin(); observer != observers_.all().rend(); ++observer) {
    try {
      (*observer)->run_ends(*this);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      status_ = stage_status_ = RunStatus::failed;
      message_ += fmt::format("{}the summary could not be written: {}", message_.empty() ? "" : "; ",
                              fault_text(error));
      save_after_failure(**observer);
    }
  }
}

/// A fault that no check of the scene detected: the state is that before the step.
void Run::fail_in_step(const std::exception& error) {
  end_stage(RunStatus::failed, fmt::format("step {} at t = {:.9g} s cannot be taken: {}",
                                           simulation().steps() + 1, simulation().time(), error.what()));
}

/// Results could not be written, e.g. on a full disk.
void Run::fail_to_write(const std::exception& error) {
  status_ = stage_status_ = RunStatus::failed;
  message_ = fmt::format("results of step {} at t = {:.9g} s could not be written: {}", simulation().steps(),
                         simulation().time(), fault_text(error));
  for (auto observer = observers_.all().rbegin(); observer != observers_.all().rend(); ++observer)
    save_after_failure(**observer);
}

void Run::save_after_failure(RunObserver& observer) {
  try {
    observer.save_after_failure(*this);
  } catch (const std::exception& error) {
    if (unsaved_.empty()) unsaved_ = fault_text(error);
  }
}

void Run::interrupt() {
  std::string message = fmt::format("interrupted after step {}", simulation().steps());
  if (!is_static(scene().analysis))
    message += fmt::format(" at t = {:.9g} s of {:.9g} s", simulation().time(), scene().analysis.end_time);
  end_stage(RunStatus::interrupted, std::move(message));
}

/// @return false if an observer could not write: the run has failed
bool Run::tell(void (RunObserver::*event)(const Run&)) {
  const auto all_told = [this](const auto& telling) {
    try {
      telling();
      return told_on_all(true);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      fail_to_write(error);
      return told_on_all(false);
    }
  };
  if (!all_told([&] { observers_.tell(event, *this); })) return false;
  return !shared() || !saver_ || all_told([&] { ((*saver_).*event)(*this); });
}

}  // namespace ashlar

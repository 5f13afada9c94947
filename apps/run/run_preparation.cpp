#include "apps/run/run_preparation.hpp"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <utility>

#include "apps/run/accuracy_choice.hpp"
#include "apps/run/answers/answer_summary.hpp"
#include "apps/run/answers/factor_analysis.hpp"
#include "apps/run/answers/trial_run.hpp"
#include "apps/scene/assemble/initial_state.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {

void RunPreparation::advance(RunStages& stages, const RunRecord& record, RunEnd& end) {
  if (next_ == Next::accuracy) choose_accuracy(stages, record, end);
  if (next_ == Next::statics && !end.status) start_statically(stages, record, end);
  if (next_ == Next::answer && !end.status) search(stages, record, end);
}

void RunPreparation::resume(const Scene& whole, RunCheckpoint checkpoint) {
  if (whole.analysis.accuracy) accuracy_ = checkpoint.accuracy;
  checkpoint_ = std::move(checkpoint);
  next_ = Next::statics;
}

void RunPreparation::finish() {
  checkpoint_.reset();
  next_ = Next::nothing;
}

void RunPreparation::choose_accuracy(RunStages& stages, const RunRecord& record, RunEnd& end) {
  if (stages.whole().analysis.accuracy) {
    std::optional<AccuracyState> choice;
    try {
      choice = choose_for_accuracy(*stages.loaded(), stages.threads(),
                                   [&record] { return record.observers().go_on(); });
      if (choice) stages.rebuild(*choice);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      end.message = fmt::format("no orders and steps could be chosen: {}", fault_text(error));
      end.status = RunStatus::failed;
      return;
    }
    if (!choice) {
      end.message = "interrupted while orders and steps were chosen";
      end.status = RunStatus::interrupted;
      return;
    }
    accuracy_ = std::move(choice);
  }
  next_ = Next::statics;
}

void RunPreparation::start_statically(RunStages& stages, const RunRecord& record, RunEnd& end) {
  if (starts_from_statics(stages.scene()) && !checkpoint_) {
    const StaticStart start =
        start_in_statics(stages.simulation(), [&record] { return record.may_continue(); });
    end.message = start.message;
    if (start.end == StaticStart::End::failed) end.status = RunStatus::failed;
    if (start.end == StaticStart::End::interrupted) end.status = RunStatus::interrupted;
    if (end.status) return;
  }
  if (seeks_answer(stages.whole().analysis))
    begin_search(stages, record);
  else
    next_ = Next::begin;
}

void RunPreparation::begin_search(RunStages& stages, const RunRecord& record) {
  // The simulation of a checkpoint is at the onset of motion already.
  if (checkpoint_) stages.rebuild();
  search_.emplace(stages.loaded(), stages.identity().scene, stages.simulation(), stages.threads(),
                  record.trial_storage(), stages.group());
  next_ = Next::answer;
}

void RunPreparation::search(RunStages& stages, const RunRecord& record, RunEnd& end) {
  if (search_->advance(stages.simulation(), record.observers())) return;
  if (search_->interrupted()) {
    end.message = search_->message();
    end.status = RunStatus::interrupted;
  } else {
    answer_ = search_->answer();
    show_answer(stages);
  }
  if (checkpoint_) stages.simulation().restore(checkpoint_->simulation);
  search_.reset();
  next_ = Next::begin;
}

/// The simulation gets the factors of the answer.
void RunPreparation::show_answer(RunStages& stages) const {
  const SceneAnalysis& analysis = stages.whole().analysis;
  if (answer_.bracket) {
    stages.rebuild(trial_factors(analysis, shown_factor(*answer_.bracket, search_of(analysis))));
    if (!checkpoint_) start_at_rest(*stages.loaded(), stages.threads(), stages.group(), stages.simulation());
  } else if (const auto factor = factor_of_states(answer_, analysis)) {
    stages.rebuild(trial_factors(analysis, *factor));
  }
}

}  // namespace ashlar

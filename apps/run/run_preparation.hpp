// The preparation of a run before its first step: choices for analysis.accuracy, the static state that a motion starts
// from, and the search for an answer, in this order; or a checkpoint in place of the first two.
#pragma once

#include <optional>

#include "apps/results/folder/accuracy_state.hpp"
#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/run/answers/answer.hpp"
#include "apps/run/answers/answer_search.hpp"
#include "apps/run/run_end.hpp"
#include "apps/run/run_record.hpp"
#include "apps/run/run_stages.hpp"

namespace ashlar {

class RunPreparation {
 public:
  /// Next step of the preparation.
  enum class Next {
    accuracy,  ///< orders, sub-faces and steps are chosen, if the scene has an accuracy
    statics,   ///< the static start, if the scene has one; then an answer is sought, if its analysis does
    answer,    ///< a piece of the search
    begin,     ///< the run begins: it is told to observers
    nothing,   ///< the run has begun
  };
  [[nodiscard]] Next next() const { return next_; }

  /// Takes the next steps up to a piece of the search. Collective.
  /// @param stages at the first one; gets the simulation that the run begins with
  /// @param end gets the message of a start; its status if the run ends with the preparation, failed or interrupted
  /// @throws std::runtime_error if a trial of the search cannot be stored, std::bad_alloc
  void advance(RunStages& stages, const RunRecord& record, RunEnd& end);
  /// Continues from a checkpoint. @pre allows_checkpoint()
  void resume(const Scene& whole, RunCheckpoint checkpoint);
  /// True before anything has been found that a checkpoint would replace.
  [[nodiscard]] bool allows_checkpoint() const { return next_ == Next::accuracy || next_ == Next::statics; }
  /// The run has begun. The checkpoint is no longer needed.
  void finish();

  /// Null: none, or the run has begun.
  [[nodiscard]] const RunCheckpoint* checkpoint() const { return checkpoint_ ? &*checkpoint_ : nullptr; }
  /// Null until it is chosen, and of a scene without an accuracy. A run changes its time step.
  [[nodiscard]] const AccuracyState* accuracy() const { return accuracy_ ? &*accuracy_ : nullptr; }
  [[nodiscard]] AccuracyState* accuracy() { return accuracy_ ? &*accuracy_ : nullptr; }
  /// Empty until a search has ended.
  [[nodiscard]] const Answer& answer() const { return answer_; }

 private:
  void choose_accuracy(RunStages& stages, const RunRecord& record, RunEnd& end);
  void start_statically(RunStages& stages, const RunRecord& record, RunEnd& end);
  void begin_search(RunStages& stages, const RunRecord& record);
  void search(RunStages& stages, const RunRecord& record, RunEnd& end);
  void show_answer(RunStages& stages) const;

  Next next_ = Next::accuracy;
  std::optional<RunCheckpoint> checkpoint_;  ///< until the run has begun; empty: none
  std::optional<AccuracyState> accuracy_;    ///< empty: not chosen, or the scene has no accuracy
  std::optional<AnswerSearch> search_;       ///< of the step `answer` only
  Answer answer_;
};

}  // namespace ashlar

#include "apps/run/answer_search.hpp"

#include <fmt/format.h>

#include <utility>

#include "apps/run/factor_analysis.hpp"
#include "apps/run/limit_run.hpp"
#include "apps/run/thrust_run.hpp"

namespace ashlar {
namespace {

/// Bounds found by limit analysis; empty if one of them is unknown.
std::optional<ExpectedFactor> expected_factor(const std::optional<LimitFindings>& limits) {
  if (!limits || !limits->answer.released.resolved) return std::nullopt;
  const LimitBracket& released = limits->answer.released;
  if (!released.lower || !released.upper) return std::nullopt;
  return ExpectedFactor{*released.lower, *released.upper};
}

bool seeks_thrust(const SceneAnalysis& analysis) {
  return analysis.type == SceneAnalysis::Type::thrust;
}

}  // namespace

bool seeks_answer(const SceneAnalysis& analysis) {
  return seeks_factor(analysis) || seeks_thrust(analysis);
}

AnswerSearch::AnswerSearch(std::shared_ptr<const LoadedScene> scene, std::uint64_t hash,
                           const Simulation& placed, int threads, TrialStorage storage)
    : scene_(std::move(scene)),
      hash_(hash),
      threads_(threads),
      storage_(std::move(storage)),
      model_(limit_model(scene_->scene, placed)),
      by_limits_(uses_limit_analysis(scene_->scene, model_)) {
  // A search by static analyses begins with the result of limit analysis for the same strengths.
  const bool limits_first = by_limits_ || (model_ && !loses_strength(*model_));
  if (!limits_first && !seeks_thrust(scene_->scene.analysis)) model_.reset();
}

bool AnswerSearch::advance(const Simulation& placed, const RunObservers& observers) {
  if (seeks_thrust(scene_->scene.analysis)) return find_thrust_first(placed, observers);
  if (model_) return find_limits_first(observers);
  return advance_trial(observers);
}

bool AnswerSearch::find_thrust_first(const Simulation& placed, const RunObservers& observers) {
  bool stopped = false;
  answer_.thrust = find_thrust(scene_->scene, std::exchange(model_, std::nullopt).value(), placed, threads_,
                               [&] { return !(stopped = stopped || !observers.go_on()); });
  if (stopped || !observers.go_on())
    interrupted_ = "interrupted while supports moved, which a new run begins with";
  return false;
}

bool AnswerSearch::find_limits_first(const RunObservers& observers) {
  answer_.limits = find_limits(scene_->scene, std::exchange(model_, std::nullopt).value(), threads_,
                               [&] { return observers.go_on(); });
  observers.tell(&RunObserver::limits_found, *answer_.limits);
  if (answer_.limits->answer.interrupted) {
    interrupted_ = fmt::format("interrupted after {} trials of limit analysis, which a new run begins with",
                               answer_.limits->answer.trials.size());
    return false;
  }
  return !by_limits_;
}

bool AnswerSearch::advance_trial(const RunObservers& observers) {
  if (!search_) {
    search_.emplace(search_of(scene_->scene.analysis), expected_factor(answer_.limits));
    if (storage_.claim)
      trials_ = std::make_unique<TrialFolder>(storage_.claim, hash_, storage_.resume, storage_.interval);
  }
  if (!trial_ && !begin_trial(observers)) return !answer_.bracket;
  if (!observers.go_on()) {
    interrupt_trial(observers);
    return false;
  }
  if (trial_->iterate()) {
    observers.tell(&RunObserver::trial_continues, trial_->factor(), trial_->iterations());
    if (trials_) trials_->save_if_due(*trial_);
    return true;
  }
  if (trials_) trials_->add(*trial_->result());
  add(*trial_->result(), trial_->reason(), observers);
  trial_.reset();
  return true;
}

/// @return false if there is no trial to run: it is known, or the search has ended
bool AnswerSearch::begin_trial(const RunObservers& observers) {
  const std::optional<double> factor = search_->next();
  if (!factor) {
    answer_.bracket = search_->bracket();
    return false;
  }
  if (const auto known = trials_ ? trials_->find(*factor) : std::nullopt) {
    add(*known, "", observers);
    return false;
  }
  trial_.emplace(*scene_, *factor, threads_);
  if (trial_->result()) {
    if (trials_) trials_->add(*trial_->result());
    add(*trial_->result(), "", observers);
    trial_.reset();
    return false;
  }
  if (trials_) trials_->begin(*trial_);
  return true;
}

void AnswerSearch::add(const FactorTrial& trial, const std::string& reason, const RunObservers& observers) {
  search_->add(trial);
  observers.tell(&RunObserver::trial_ends, trial, reason);
}

void AnswerSearch::interrupt_trial(const RunObservers& observers) {
  if (trials_) trials_->save(*trial_);
  observers.tell(&RunObserver::trial_stops, trial_->factor(), trial_->iterations());
  const FactorBracket bracket = search_->bracket();
  interrupted_ = fmt::format(
      "interrupted after {} static analyses, {}; {}", bracket.trials.size(), bracket_so_far(bracket),
      trials_ ? fmt::format("they and the state of the one that was stopped are in {}, "
                            "the same command with --resume goes on",
                            storage_.claim->folder().string())
              : std::string("nothing is saved"));
}

}  // namespace ashlar

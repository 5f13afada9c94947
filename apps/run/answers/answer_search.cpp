#include "apps/run/answers/answer_search.hpp"

#include <fmt/format.h>

#include <utility>

#include "apps/run/answers/factor_analysis.hpp"
#include "apps/run/answers/limit_run.hpp"
#include "apps/run/answers/pushover_run.hpp"
#include "apps/run/answers/thrust_run.hpp"
#include "apps/run/run_setup.hpp"

namespace ashlar {
namespace {

/// Bounds found along the load path of limit analysis; empty if one of them is unknown.
std::optional<ExpectedFactor> expected_factor(const std::optional<LimitFindings>& limits) {
  if (!limits || !limits->path.answer.resolved) return std::nullopt;
  const PathAnswer& path = limits->path.answer;
  if (!path.lower || !path.upper) return std::nullopt;
  return ExpectedFactor{*path.lower, *path.upper};
}

/// Answer of the first process for all.
struct FoundLimits {
  LimitFindings limits;
  std::vector<ShownState> states;
};

struct FoundThrust {
  ThrustFindings thrust;
  std::vector<ShownState> states;
};

struct FoundPushover {
  PushoverFindings pushover;
  std::vector<ShownState> states;
};

bool seeks_thrust(const SceneAnalysis& analysis) {
  return analysis.type == SceneAnalysis::Type::thrust;
}

bool seeks_pushover(const SceneAnalysis& analysis) {
  return analysis.type == SceneAnalysis::Type::pushover;
}

}  // namespace

bool seeks_answer(const SceneAnalysis& analysis) {
  return seeks_factor(analysis) || seeks_thrust(analysis) || seeks_pushover(analysis);
}

AnswerSearch::AnswerSearch(std::shared_ptr<const LoadedScene> scene, std::uint64_t hash,
                           const Simulation& placed, int threads, TrialStorage storage, const RunGroup& group)
    : scene_(std::move(scene)),
      hash_(hash),
      threads_(threads),
      storage_(std::move(storage)),
      group_(group),
      plan_(group_.result_of_first([&] { return planned(placed); })),
      stores_(group_.result_of_first([&] { return storage_.claim != nullptr; })) {}

/// Makes the rigid model, on the first process.
AnswerSearch::Plan AnswerSearch::planned(const Simulation& placed) {
  if (group_.shared()) whole_.emplace(built_or_thrown(*scene_, threads_));
  model_ = limit_model(scene_->scene, whole_ ? whole_->simulation : placed);
  const MethodChoice method = choose_method(scene_->scene, whole_ ? whole_->simulation : placed, model_);
  const bool by_limits = method.limit;
  // A search by static analyses begins with the result of limit analysis for the same strengths.
  const bool limits_first = by_limits || (model_ && !loses_strength(*model_));
  if (!limits_first && !seeks_thrust(scene_->scene.analysis) && !seeks_pushover(scene_->scene.analysis)) {
    model_.reset();
    whole_.reset();
  }
  return {limits_first, by_limits, method.reason};
}

bool AnswerSearch::may_continue(const RunObservers& observers) const {
  return !group_.any(!observers.go_on());
}

bool AnswerSearch::advance(const Simulation& placed, const RunObservers& observers) {
  if (seeks_thrust(scene_->scene.analysis)) return find_thrust_first(placed, observers);
  if (seeks_pushover(scene_->scene.analysis)) return find_pushover_first(placed, observers);
  if (!plan_.reason.empty()) {
    answer_.method_reason = std::exchange(plan_.reason, "");
    observers.tell(&RunObserver::method_chosen, plan_.by_limits, answer_.method_reason);
  }
  if (std::exchange(plan_.limits_first, false)) return find_limits_first(placed, observers);
  return advance_trial(observers);
}

bool AnswerSearch::find_thrust_first(const Simulation& placed, const RunObservers& observers) {
  bool stopped = false;
  FoundThrust found = group_.result_of_first([&] {
    const Simulation& simulation = whole_ ? whole_->simulation : placed;
    FoundThrust first;
    first.thrust = find_thrust(scene_->scene, std::exchange(model_, std::nullopt).value(), simulation,
                               threads_, [&] { return !(stopped = stopped || !observers.go_on()); });
    first.states = thrust_states(first.thrust, simulation);
    return first;
  });
  answer_.thrust = std::move(found.thrust);
  answer_.states = std::move(found.states);
  whole_.reset();
  if (group_.any(stopped) || !may_continue(observers))
    interrupted_ = "interrupted while supports moved, which a new run begins with";
  return false;
}

bool AnswerSearch::find_pushover_first(const Simulation& placed, const RunObservers& observers) {
  bool stopped = false;
  FoundPushover found = group_.result_of_first([&] {
    const Simulation& simulation = whole_ ? whole_->simulation : placed;
    FoundPushover first;
    first.pushover = find_pushover(scene_->scene, simulation, threads_,
                                   [&] { return !(stopped = stopped || !observers.go_on()); });
    first.states = pushover_states(first.pushover);
    return first;
  });
  answer_.pushover = std::move(found.pushover);
  answer_.states = std::move(found.states);
  model_.reset();
  whole_.reset();
  if (group_.any(stopped) || !may_continue(observers))
    interrupted_ = "interrupted while blocks were pushed, which a new run begins with";
  return false;
}

bool AnswerSearch::find_limits_first(const Simulation& placed, const RunObservers& observers) {
  FoundLimits found = group_.result_of_first([&] {
    const Simulation& simulation = whole_ ? whole_->simulation : placed;
    FoundLimits first;
    first.limits = find_limits(scene_->scene, std::exchange(model_, std::nullopt).value(), simulation,
                               threads_, [&] { return observers.go_on(); });
    first.states = limit_states(first.limits, scene_->scene.analysis, simulation);
    return first;
  });
  answer_.limits = std::move(found.limits);
  answer_.states = std::move(found.states);
  whole_.reset();
  observers.tell(&RunObserver::limits_found, *answer_.limits);
  if (answer_.limits->answer.interrupted) {
    interrupted_ = fmt::format("interrupted after {} trials of limit analysis, which a new run begins with",
                               answer_.limits->answer.trials.size());
    return false;
  }
  return !plan_.by_limits;
}

bool AnswerSearch::advance_trial(const RunObservers& observers) {
  if (!search_) {
    search_.emplace(search_of(scene_->scene.analysis), expected_factor(answer_.limits));
    group_.do_on_each([&] {
      if (storage_.claim)
        trials_ = std::make_unique<TrialFolder>(storage_.claim, hash_, storage_.resume, storage_.interval);
    });
  }
  if (!trial_ && !begin_trial(observers)) return !answer_.bracket;
  if (!may_continue(observers)) {
    interrupt_trial(observers);
    return false;
  }
  if (trial_->iterate()) {
    observers.tell(&RunObserver::trial_continues, trial_->factor(), trial_->iterations());
    if (stores_ && group_.result_of_first([&] { return trials_->due(); })) save_trial();
    return true;
  }
  store_result();
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
  if (stores_) {
    if (const auto known = group_.result_of_first([&] { return trials_->find(*factor); })) {
      add(*known, "", observers);
      return false;
    }
  }
  trial_.emplace(*scene_, *factor, threads_, group_);
  if (trial_->result()) {
    store_result();
    add(*trial_->result(), "", observers);
    trial_.reset();
    return false;
  }
  if (stores_)
    if (const auto state = group_.result_of_first([&] { return trials_->begin(*factor); }))
      trial_->restore(*state);
  return true;
}

void AnswerSearch::save_trial() {
  const RunCheckpoint state = trial_->state();
  group_.do_on_each([&] {
    if (trials_) trials_->save(trial_->factor(), state);
  });
}

void AnswerSearch::store_result() {
  group_.do_on_each([&] {
    if (trials_) trials_->add(*trial_->result());
  });
}

void AnswerSearch::add(const FactorTrial& trial, const std::string& reason, const RunObservers& observers) {
  search_->add(trial);
  observers.tell(&RunObserver::trial_ends, trial, reason);
}

void AnswerSearch::interrupt_trial(const RunObservers& observers) {
  if (stores_) save_trial();
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

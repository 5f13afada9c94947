#include "apps/program/fragility/limit_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/results/tables/history_table.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/run.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::size_t place_of(const std::vector<std::string>& columns, const std::string& name) {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
}

std::optional<std::size_t> stage_column(const std::vector<std::string>& columns) {
  const std::size_t place = place_of(columns, "stage");
  return place < columns.size() ? std::optional(place) : std::nullopt;
}

void judge(const Limit& limit, double demand, double time, JudgedLimit& outcome) {
  outcome.demand = limit.worse(outcome.demand, demand);
  if (!outcome.time && limit.exceeded_by(demand)) outcome.time = time;
}

/// The outcome by one limit of the rows of a history.
JudgedLimit of_history(const Limit& limit, const HistoryTable& history) {
  JudgedLimit outcome{limit.text, none, {}};
  const DemandOfRow demand = demand_of_row(limit, history.columns);
  const std::optional<std::size_t> stage = stage_column(history.columns);
  const std::size_t time = place_of(history.columns, "time");
  for (const std::vector<double>& row : history.rows)
    if (!stage || row[*stage] == history.rows.back()[*stage]) judge(limit, demand(row), row[time], outcome);
  return outcome;
}

HistoryTable whole_history(const std::filesystem::path& folder) {
  return read_history(folder / "history.csv", std::numeric_limits<std::size_t>::max());
}

JudgedRun outcome_in(const Json& json) {
  JudgedRun outcome;
  outcome.time = json.at("time").get<double>();
  outcome.state = json.at("state").get<std::string>();
  if (const Json& collapse = json.at("collapse"); !collapse.is_null())
    outcome.collapse = Collapse{collapse.at("time").get<double>(), collapse.at("block").get<std::string>(),
                                collapse.at("how").get<std::string>()};
  for (const Json& limit : json.at("limits")) {
    JudgedLimit& of = outcome.limits.emplace_back();
    of.limit = limit.at("limit").get<std::string>();
    of.demand = limit.at("demand").is_null() ? none : limit.at("demand").get<double>();
    if (!limit.at("time").is_null()) of.time = limit.at("time").get<double>();
  }
  if (const Json& since = json.at("resting_since"); !since.is_null())
    outcome.resting_since = since.get<double>();
  return outcome;
}

}  // namespace

std::optional<bool> JudgedRun::exceeded(std::size_t limit) const {
  if (collapse || limits[limit].time) return true;
  if (state == "at rest" || state == "moving") return false;
  return std::nullopt;
}

bool JudgedRun::certain() const {
  for (std::size_t k = 0; k < limits.size(); ++k)
    if (!exceeded(k)) return false;
  return true;
}

std::filesystem::path outcome_file(const std::filesystem::path& folder) {
  return folder.string() + ".outcome.json";
}

std::optional<JudgedRun> stored_outcome(const std::filesystem::path& folder,
                                        const std::vector<Limit>& limits) {
  const std::filesystem::path file = outcome_file(folder);
  if (!std::filesystem::exists(file)) return std::nullopt;
  JudgedRun stored = naming_the_file(file, [&] { return outcome_in(parse_json(whole_file(file))); });
  std::vector<JudgedLimit> known = std::move(stored.limits);
  stored.limits.clear();
  std::optional<HistoryTable> history;
  for (const Limit& limit : limits) {
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const JudgedLimit& of) { return of.limit == limit.text; });
    if (found != known.end()) {
      stored.limits.push_back(*found);
      continue;
    }
    if (!limit.is_collapse() && !history) history = whole_history(folder);
    stored.limits.push_back(limit.is_collapse() ? JudgedLimit{limit.text, none, {}}
                                                : of_history(limit, *history));
  }
  return stored;
}

void store_outcome(const JudgedRun& outcome, const std::filesystem::path& folder) {
  Json json = {
      {"time", outcome.time}, {"state", outcome.state}, {"collapse", nullptr}, {"limits", Json::array()}};
  if (outcome.collapse)
    json["collapse"] = {
        {"time", outcome.collapse->time}, {"block", outcome.collapse->block}, {"how", outcome.collapse->how}};
  for (const JudgedLimit& of : outcome.limits)
    json["limits"].push_back(
        {{"limit", of.limit}, {"demand", of.demand}, {"time", of.time ? Json(*of.time) : Json(nullptr)}});
  json["resting_since"] = outcome.resting_since ? Json(*outcome.resting_since) : Json(nullptr);
  write_file_atomically(outcome_file(folder), json_text(json, 1) + "\n", Durability::process);
}

LimitWatch::LimitWatch(std::vector<Limit> limits, std::filesystem::path folder, double record_end)
    : limits_(std::move(limits)), folder_(std::move(folder)), record_end_(record_end) {
  for (const Limit& limit : limits_) outcome_.limits.push_back({limit.text, none, {}});
}

void LimitWatch::run_begins(const Run& run) {
  const std::vector<std::string> columns = run.columns();
  for (const Limit& limit : limits_) demands_.push_back(demand_of_row(limit, columns));
  stage_column_ = stage_column(columns);
  last_stage_ = static_cast<double>(run.whole().stage.size());
  time_column_ = place_of(columns, "time");
  collapse_.emplace(run.whole(), run.simulation());
  if (run.simulation().steps() > 0)
    judge_earlier(run);
  else
    std::filesystem::remove(outcome_file(folder_));  // of results that this run replaces
}

/// Of a run that is continued, up to its checkpoint: later rows are no longer in the file.
void LimitWatch::judge_earlier(const Run& run) {
  for (const std::vector<double>& row : whole_history(folder_).rows) judge_row(row);
  const std::optional<JudgedRun> earlier = stored_outcome(folder_, {});
  if (earlier && earlier->time == run.simulation().time()) outcome_.resting_since = earlier->resting_since;
  if (in_last_stage(run)) judge_state(run);
}

bool LimitWatch::in_last_stage(const Run& run) const {
  return !stage_column_ || static_cast<double>(run.stage()) == last_stage_;
}

void LimitWatch::judge_row(const std::vector<double>& row) {
  if (stage_column_ && row[*stage_column_] != last_stage_) return;
  outcome_.time = row[time_column_];
  for (std::size_t k = 0; k < limits_.size(); ++k)
    judge(limits_[k], demands_[k](row), row[time_column_], outcome_.limits[k]);
}

void LimitWatch::judge_state(const Run& run) {
  const Simulation& simulation = run.simulation();
  if (auto collapse = collapse_->collapse_in(simulation)) {
    outcome_.collapse = std::move(collapse);
    outcome_.state = "collapsed";
    return;
  }
  if (outcome_.certain()) {
    outcome_.state = "exceeded";
    return;
  }
  if (simulation.time() < record_end_ || !verdict_of(simulation, {}).at_rest()) {
    outcome_.resting_since.reset();
    return;
  }
  if (!outcome_.resting_since) outcome_.resting_since = simulation.time();
  if (simulation.time() - *outcome_.resting_since >= collapse_->rest_duration()) outcome_.state = "at rest";
}

void LimitWatch::step_taken(const Run& run) {
  for (; judged_ < run.rows().size(); ++judged_) judge_row(run.rows()[judged_]);
  if (in_last_stage(run)) judge_state(run);
}

void LimitWatch::run_ends(const Run& run) {
  if (run.status() == RunStatus::completed && !outcome_.collapse)
    outcome_.state = verdict_of(run.simulation(), {}).at_rest() ? "at rest" : "moving";
  store_outcome(outcome_, folder_);
}

}  // namespace ashlar

#include "apps/run/run_history.hpp"

#include <utility>

#include "apps/results/tables/measure_goals.hpp"

namespace ashlar {

RunHistory::RunHistory(std::vector<Measure> measures, bool keeps_rows)
    : measures_(std::move(measures)), keeps_rows_(keeps_rows) {}

void RunHistory::add(const Simulation& simulation, const StagePlace& place, int stage) {
  if (!keeps_rows_) return;
  std::vector<double>& row = rows_.emplace_back();
  row.push_back(static_cast<double>(simulation.steps()));
  const std::vector<double> values = history_row(simulation, measures_, place.origin, stage);
  row.insert(row.end(), values.begin(), values.end());
}

GoalValues RunHistory::goals() const {
  return [this](const Simulation& now) { return goals_of(now, measures_); };
}

void RunHistory::share_needs(const RunGroup& group) {
  row_needs_ = group.value_of_first(needs_of(measures_));
}

ResultNeeds RunHistory::needs(ResultFolder::Due due) const {
  ResultNeeds needs = due == ResultFolder::Due::row ? row_needs_ : ResultNeeds{false, {}, {}};
  needs.all = due == ResultFolder::Due::frame;
  return needs;
}

}  // namespace ashlar

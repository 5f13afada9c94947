// The measures of a run, and the rows of its history in memory.
#pragma once

#include <utility>
#include <vector>

#include "apps/results/columns/history_columns.hpp"
#include "apps/results/folder/result_folder.hpp"
#include "apps/results/tables/measure.hpp"
#include "apps/run/run_group.hpp"
#include "solver/accuracy/static_accuracy.hpp"

namespace ashlar {

class RunHistory {
 public:
  /// @param measures of the whole scene; none on processes that do not write results. @param keeps_rows false: none is added
  RunHistory(std::vector<Measure> measures, bool keeps_rows);

  [[nodiscard]] const std::vector<Measure>& measures() const { return measures_; }
  /// The same measures of blocks that have cracked.
  void set_measures(std::vector<Measure> measures) { measures_ = std::move(measures); }
  [[nodiscard]] bool keeps_rows() const { return keeps_rows_; }
  /// @param staged true: with the number of the stage
  [[nodiscard]] std::vector<Column> columns(bool staged) const { return history_columns(measures_, staged); }

  /// Adds a row for the present step. @param stage 1-based number; 0: the scene has none
  void add(const Simulation& simulation, const StagePlace& place, int stage);
  /// By step, in the order of columns().
  [[nodiscard]] const std::vector<std::vector<double>>& rows() const { return rows_; }

  /// Values of the measures, which must not outlive this.
  [[nodiscard]] GoalValues goals() const;

  /// All processes learn what rows of the first one need. Collective.
  void share_needs(const RunGroup& group);
  /// Results that the first process needs of the others. @pre share_needs() was called
  [[nodiscard]] ResultNeeds needs(ResultFolder::Due due) const;

 private:
  std::vector<Measure> measures_;
  bool keeps_rows_;
  std::vector<std::vector<double>> rows_;
  ResultNeeds row_needs_;
};

}  // namespace ashlar

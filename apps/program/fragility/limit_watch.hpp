// Judges a run by its limits, step by step, and ends it as soon as its outcome is certain.
//
// The outcome of a run is certain
// - when each limit is exceeded, or a block has collapsed (collapse_watch.hpp), which exceeds them all;
// - when all blocks have been at rest for CollapseWatch::rest_duration() after the end of the record;
// - at the end of the scene.
// Limits are judged in the last stage of a scene. A run that ends before the end of the scene is an interrupted one: with
// other limits it can go on.
//
// The outcome is a file beside the folder of the run. Demands of limits that it does not have are those of history.csv.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/fragility/collapse_watch.hpp"
#include "apps/program/fragility/limit.hpp"
#include "apps/run/run_observer.hpp"

namespace ashlar {

/// Outcome of a run by one limit.
struct JudgedLimit {
  std::string limit;           ///< Limit::text
  double demand;               ///< worst so far; nan: none, of a collapse
  std::optional<double> time;  ///< s, when the limit was first exceeded by the demand
};

struct JudgedRun {
  double time = 0.0;  ///< s, up to which the run was judged
  /// "collapsed", "exceeded" (each limit), "at rest", "moving" (at the end of the scene); empty: not certain yet
  std::string state;
  std::optional<Collapse> collapse;
  std::vector<JudgedLimit> limits;      ///< in the order of the limits asked for
  std::optional<double> resting_since;  ///< s; empty: blocks move, or the record has not ended

  /// True if a limit is exceeded, by its demand or by a collapse. Empty: not certain. @param limit index
  [[nodiscard]] std::optional<bool> exceeded(std::size_t limit) const;
  /// True if that is known of each limit.
  [[nodiscard]] bool certain() const;
};

/// File of the outcome of a run. @param folder of the run
[[nodiscard]] std::filesystem::path outcome_file(const std::filesystem::path& folder);

/// The stored outcome of a run. Demands that it does not have are computed from the history of the run, if there is one.
/// @return empty: none is stored. @throws std::runtime_error with path and reason if files are damaged
[[nodiscard]] std::optional<JudgedRun> stored_outcome(const std::filesystem::path& folder,
                                                      const std::vector<Limit>& limits);

/// @throws std::runtime_error with path and reason
void store_outcome(const JudgedRun& outcome, const std::filesystem::path& folder);

class LimitWatch : public RunObserver {
 public:
  /// @param folder of the run, whose history has the steps before those of a run that is continued
  /// @param record_end s, end of the record in the last stage
  LimitWatch(std::vector<Limit> limits, std::filesystem::path folder, double record_end);

  [[nodiscard]] bool may_continue() override { return !outcome_.certain(); }
  void run_begins(const Run& run) override;
  void step_taken(const Run& run) override;
  /// Stores the outcome, also one that is not certain: the run may be continued.
  void run_ends(const Run& run) override;

  [[nodiscard]] const JudgedRun& outcome() const { return outcome_; }

 private:
  void judge_earlier(const Run& run);
  void judge_row(const std::vector<double>& row);
  void judge_state(const Run& run);
  [[nodiscard]] bool in_last_stage(const Run& run) const;

  std::vector<Limit> limits_;
  std::filesystem::path folder_;
  double record_end_;
  std::vector<DemandOfRow> demands_;
  std::optional<std::size_t> stage_column_;  ///< empty: a scene without stages
  double last_stage_ = 0.0;                  ///< its number in that column
  std::size_t time_column_ = 0;
  std::size_t judged_ = 0;  ///< rows of the run
  std::optional<CollapseWatch> collapse_;
  JudgedRun outcome_;
};

}  // namespace ashlar

// The observers of a run, and its record in a result folder.
#pragma once

#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/folder/result_folder.hpp"
#include "apps/run/answers/answer_search.hpp"
#include "apps/run/checkpoint_saver.hpp"
#include "apps/run/folder_recorder.hpp"
#include "apps/run/run_end.hpp"
#include "apps/run/run_group.hpp"
#include "apps/run/run_observer.hpp"

namespace ashlar {

struct RunCheckpoint;

/// An event of a run that has begun.
using RunEvent = void (RunObserver::*)(const Run&);

/// Of several processes the first one has a folder; all take part in its checkpoints.
class RunRecord {
 public:
  explicit RunRecord(const RunGroup& group) : group_(group) {}

  /// @param observer not null
  void add(std::shared_ptr<RunObserver> observer) { observers_.add(std::move(observer)); }
  [[nodiscard]] const RunObservers& observers() const { return observers_; }
  /// False if an observer of any process ends the run. Collective.
  [[nodiscard]] bool may_continue() const { return !group_.any(!observers_.go_on()); }

  /// Tells that the run begins. Collective. @throws what an observer has thrown, on all processes
  void begin(const Run& run) const;
  /// Collective. @param end of the run, which fails if an observer of any process throws: results could not be written
  /// @return false if it has failed
  bool tell(RunEvent event, const Run& run, RunEnd& end) const;
  /// Tells that the run has ended, the last observer first: the last state is saved before the summary tells the end.
  /// @param end fails if an observer throws
  void tell_end(const Run& run, RunEnd& end) const;

  /// Attaches observers that record the run (Run::record). @param claim null on processes without a folder
  /// @param earlier checkpoint whose record is continued; null: a new one
  void record(Run& run, std::shared_ptr<const FolderClaim> claim, std::optional<double> interval,
              bool keeps_trials, const RunCheckpoint* earlier);
  /// @throws std::logic_error if there is a folder already
  void require_unrecorded() const;
  /// True if the folder has a checkpoint of the run.
  [[nodiscard]] bool saved() const { return saver_ && saver_->saved(); }
  /// In the same folder.
  [[nodiscard]] const TrialStorage& trial_storage() const { return trials_; }

  /// Results of the last step that the first process writes, on all. Collective. @param keeps_rows true: also in memory
  [[nodiscard]] ResultFolder::Due due(const Run& run, bool keeps_rows) const;
  /// Frames in the folder; 0 without one.
  [[nodiscard]] int frames() const { return recorder_ ? recorder_->frames() : 0; }
  /// Empty: there is no folder, or the run has not begun.
  [[nodiscard]] std::optional<LargestValues> largest(const Simulation& simulation) const;
  /// Adds `peaks` of the measures; nothing without a folder.
  void add_peaks(nlohmann::ordered_json& summary) const;
  /// Nothing without a folder.
  void write_summary(const Run& run) const;

 private:
  bool told_everywhere(bool told, RunEnd& end) const;
  void fail_to_write(const std::exception& error, const Run& run, RunEnd& end) const;

  RunGroup group_;
  RunObservers observers_;
  std::shared_ptr<FolderRecorder> recorder_;  ///< null: none
  std::shared_ptr<CheckpointSaver> saver_;    ///< null: none
  /// The saver of several processes: collective, and so told once the observers of all have been. Null: none
  std::shared_ptr<RunObserver> last_;
  TrialStorage trials_;  ///< without a claim: there is no folder
};

}  // namespace ashlar

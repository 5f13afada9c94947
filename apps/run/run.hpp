// A run of a scene, driven by its caller: step by step, stage after stage, with access to the blocks in between.
//
//   Diagnostics faults;
//   auto scene = load_scene("wall.toml", {}, faults);    // scene_loading.hpp; faults.print(std::cerr)
//   Run run(std::move(*scene));
//   run.record("wall.out");                              // as `ashlar run` does; run.resume("wall.out") continues it
//   while (run.step()) ...                               // run.motion("brick.1", point).stress
//
// Progress, results, checkpoints and interrupts are observers (run_observer.hpp): `ashlar run` is a run with all of
// them. A run shares no state: several may run at a time, each in a thread of its own.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/results/folder/accuracy_state.hpp"
#include "apps/results/folder/contact_changes.hpp"
#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/folder/motion_verdict.hpp"
#include "apps/results/folder/result_folder.hpp"
#include "apps/results/folder/run_clock.hpp"
#include "apps/results/folder/run_outcome.hpp"
#include "apps/results/folder/run_status.hpp"
#include "apps/results/folder/scene_identity.hpp"
#include "apps/results/tables/block_points.hpp"
#include "apps/results/tables/measure.hpp"
#include "apps/run/answers/answer.hpp"
#include "apps/run/run_observer.hpp"
#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/accuracy/goal_error.hpp"
#include "solver/run/order_error.hpp"

namespace ashlar {

class AnswerSearch;
class CheckpointSaver;
class FolderRecorder;
struct RunCheckpoint;

/// Options of a run.
struct RunManner {
  int threads = 1;                 ///< >= 1
  bool keeps_history = true;       ///< rows() of all steps in memory
  double began = RunClock::now();  ///< start of the wall time of a summary
  /// Processes that share the run, each with a Run of its own that its caller steps; null: none. Observers, records and
  /// rows are for the first one
  const RunRanks* ranks = nullptr;
};

class Run {
 public:
  /// Builds the blocks. @param scene not null. @param threads >= 1
  /// @throws std::invalid_argument "FILE:LINE:COLUMN: error: ..." if blocks cannot be built, or blocks of a static
  /// analysis are unsupported, or a search has nothing to find; and for invalid arguments
  explicit Run(std::shared_ptr<const LoadedScene> scene, int threads = 1);
  explicit Run(LoadedScene scene, int threads = 1)
      : Run(std::make_shared<const LoadedScene>(std::move(scene)), threads) {}
  /// @param built of the first stage (run_setup.hpp)
  Run(std::shared_ptr<const LoadedScene> scene, BuiltSimulation built, const RunManner& manner);
  ~Run();
  Run(Run&&) noexcept;
  Run& operator=(Run&&) noexcept;

  /// Finds the equilibrium that a motion starts from, or the answer of a search for a factor, thrust or movements. The
  /// first step does it otherwise, piece by piece. The run may end with it: failed, or interrupted by an observer.
  /// @throws std::runtime_error if the start cannot be recorded: the run has not begun then
  void begin();

  /// Takes a step, or an iteration of a static analysis, or before those a piece of the search for an answer. After the
  /// end of a stage, the next call starts the next one.
  /// @return true if the run has not ended
  /// @throws std::runtime_error with the reason if the step cannot be taken, results cannot be written, or the run ends
  /// with blocks too deep in each other; the state is then the last valid one, status() is failed, and further calls
  /// throw the same. std::bad_alloc without memory, possibly within a step: nothing is written, and checkpoints remain
  bool step();

  /// Empty until the run has ended.
  [[nodiscard]] std::optional<RunStatus> status() const { return status_; }
  /// Moving blocks, the answer of a search, or the reason of a failure; empty: no message.
  [[nodiscard]] const std::string& message() const { return message_; }
  /// Reason why the end of a failed run is not saved; empty: it is saved, or not recorded.
  [[nodiscard]] const std::string& unsaved() const { return unsaved_; }
  /// 1-based number of the present stage; 0: the scene has none.
  [[nodiscard]] int stage() const { return whole().stage.empty() ? 0 : place_.stage; }
  /// Status of the present stage at its end.
  [[nodiscard]] RunStatus stage_status() const { return stage_status_; }
  /// True if a stage follows the present one, which has reached its end.
  [[nodiscard]] bool stage_follows() const { return phase_ == Phase::stage_over; }
  /// The scene of all stages, and of the present one.
  [[nodiscard]] const Scene& whole() const { return scene_->scene; }
  [[nodiscard]] const Scene& scene() const { return present_->scene; }
  [[nodiscard]] const SceneIdentity& identity() const { return identity_; }
  /// Blocks, states, contacts, time (s, of the present stage), steps. During a search for a factor: as placed.
  [[nodiscard]] const Simulation& simulation() const { return built_.simulation; }
  [[nodiscard]] const BuiltSimulation& built() const { return built_; }
  /// Of a search; empty until it has ended.
  [[nodiscard]] const Answer& answer() const { return answer_; }

  /// Index of a block in simulation().blocks(). @throws std::out_of_range if there is none of that name
  [[nodiscard]] int block(const std::string& name) const;
  /// True if a block is present in the present stage: stages remove blocks, and add others later.
  /// @param index in simulation().blocks()
  [[nodiscard]] bool present(int index) const { return simulation().system().present(index); }
  /// @throws std::logic_error with its name and that of the stage if it is absent: its state has no meaning
  void require_present(int index) const;
  /// Present motion of points of a block: place (m), displacement (m), velocity (m/s), Cauchy stress (Pa, tension
  /// positive). Places and points are in the user's coordinates, those of simulation() relative to whole().origin.
  /// @param points m, of the placed, undeformed block, see BlockPoints
  /// @throws std::out_of_range; std::logic_error as require_present; std::domain_error if a point is refused
  [[nodiscard]] std::vector<PointMotion> motions(int index, const std::vector<Vector3>& points,
                                                 OutsidePoints outside = OutsidePoints::refused) const;
  [[nodiscard]] PointMotion motion(const std::string& name, const Vector3& point,
                                   OutsidePoints outside = OutsidePoints::refused) const;
  /// Multiplies a load of a block by a factor, from the next step on (Simulation::set_load_factor). A static analysis
  /// that has ended continues under the new load. A run that has not begun does so.
  /// @param load its number among the block's loads, from 0. @throws std::out_of_range, std::invalid_argument;
  /// std::logic_error for a search, whose loads are those of the scene
  void set_load_factor(const std::string& name, int load, double factor);

  /// Names of the columns of history.csv.
  [[nodiscard]] std::vector<std::string> columns() const;
  /// history.units.json: their units and meanings.
  [[nodiscard]] std::string column_units() const;
  /// Rows for the start, once the run has begun, and for each step, with the values of columns().
  [[nodiscard]] const std::vector<std::vector<double>>& rows() const { return rows_; }

  /// Attaches an observer, which is told that the run and its stage begin if they have begun already.
  /// @param observer not null. @throws its exceptions: it is not attached then
  void observe(std::shared_ptr<RunObserver> observer);
  /// Writes each step from the present one on into a result folder, as `ashlar run` does: frames when they are due,
  /// checkpoints, and the summary at the end. @throws ClaimRefused, std::runtime_error; std::logic_error if the run is
  /// recorded already, or has ended
  void record(const std::filesystem::path& folder, ClaimPurpose purpose = ClaimPurpose::new_run);
  /// @param claim not null but on ranks other than the first, which take part in checkpoints
  /// @param interval s between checkpoints; empty: growing, see CheckpointSchedule
  /// @param kept true: a search for a factor continues with the trials in the folder
  void record(std::shared_ptr<const FolderClaim> claim, std::optional<double> interval, bool kept);
  /// Continues the recorded run of a result folder from its checkpoint, and its record. rows() start there.
  /// @throws ClaimRefused; CheckpointError (run_checkpoint.hpp); std::invalid_argument if it has passed the scene's
  /// end_time; std::runtime_error; std::logic_error if this run has begun or is recorded
  void resume(const std::filesystem::path& folder);
  /// Continues from a checkpoint of the same scene. @throws std::invalid_argument, std::runtime_error as above
  void resume(RunCheckpoint checkpoint);
  /// True if a record has a checkpoint.
  [[nodiscard]] bool saved() const;

  /// Data for a checkpoint between two steps, without those of the folder.
  [[nodiscard]] RunCheckpoint checkpoint() const;
  /// The same without pairs and records of the simulation (Simulation::pairs_of_run).
  [[nodiscard]] RunCheckpoint checkpoint_without_pairs() const;
  /// Largest values, with displacements relative to the last reset by a stage.
  [[nodiscard]] LargestValues largest() const;
  /// Errors of the orders of blocks: of a dynamic run at present, of a static analysis in equilibrium. Empty: others
  [[nodiscard]] std::vector<OrderError> order_errors() const;
  /// Errors of the measures of a static analysis that has ended in equilibrium, without analysis.accuracy. Empty: others
  [[nodiscard]] const std::vector<GoalError>& measure_errors() const { return measure_errors_; }
  /// Choices for analysis.accuracy; null: the scene has none, or the run has not begun
  [[nodiscard]] const AccuracyState* accuracy() const {
    return chosen_ && whole().analysis.accuracy ? &accuracy_ : nullptr;
  }
  /// Of the last stage in time that has ended; empty: none has.
  [[nodiscard]] const std::optional<MotionVerdict>& verdict() const { return verdict_; }
  /// summary.json, with the answer of a search; status interrupted if the run has not ended.
  [[nodiscard]] std::string summary() const;
  /// The same of a record. @param frames written so far
  [[nodiscard]] std::string summary(int frames, const LargestValues& largest) const;
  /// Position in the stages, for results.
  [[nodiscard]] const StagePlace& place() const { return place_; }
  /// Writes the summary of a recorded run now.
  void write_summary() const;
  /// Writes the present state as the only frame, all rows and the summary into a result folder, replacing existing
  /// results.
  /// @throws ClaimRefused, std::runtime_error
  void write(const std::filesystem::path& folder) const;

 private:
  enum class Phase {
    preparing,    ///< before the initial state is found
    stage_start,  ///< before the first step of a stage
    in_stage,
    stage_over,  ///< another stage follows
  };

  Run(const std::shared_ptr<const LoadedScene>& scene, const RunManner& manner);
  void prepare_piece();
  bool choose_accuracy();
  bool start_statically();
  bool search_piece();
  void advance();
  bool begin_next_stage();
  void reset_displacement();
  void take_step();
  [[nodiscard]] GoalValues goals_of_measures() const;
  void estimate_measures();
  void take_iteration();
  void end_undecided();
  void show_state();
  bool accept_step();
  void gather_due();
  [[nodiscard]] ResultFolder::Due due() const;
  bool record_step();
  void end_stage(RunStatus status, std::string message);
  void end(RunStatus status);
  [[nodiscard]] bool moves_in_time() const;
  [[nodiscard]] FallRecord falls_of_run() const;
  void judge_motion();
  void fail_in_step(const std::exception& error);
  void fail_to_write(const std::exception& error);
  void interrupt();
  bool tell(void (RunObserver::*event)(const Run&));
  bool goes_on() const;
  bool told_on_all(bool told);
  [[nodiscard]] bool shared() const { return manner_.ranks != nullptr && manner_.ranks->several(); }
  void save_after_failure(RunObserver& observer);
  void add_row();
  [[nodiscard]] FinishedStage finished(RunStatus status) const;

  std::shared_ptr<const LoadedScene> scene_;    ///< of all stages
  std::shared_ptr<const LoadedScene> present_;  ///< the present stage
  SceneIdentity identity_;
  RunManner manner_;
  RunClock clock_;
  BuiltSimulation built_;
  std::vector<Measure> measures_;
  Phase phase_ = Phase::preparing;
  bool chosen_ = false;                     ///< orders and sub-faces of a scene with an accuracy are known
  AccuracyState accuracy_;                  ///< of a scene with an accuracy
  bool started_ = false;                    ///< the initial equilibrium, if one is required, is known
  std::unique_ptr<RunCheckpoint> earlier_;  ///< until the run has begun; null: none
  std::unique_ptr<AnswerSearch> search_;    ///< while it runs
  Answer answer_;
  StagePlace place_;
  std::vector<FinishedStage> finished_;  ///< those before the present stage
  RunStatus stage_status_ = RunStatus::completed;
  std::vector<std::vector<double>> rows_;
  std::vector<GoalError> measure_errors_;
  std::vector<RankWork> rank_work_;       ///< of processes that share the run, at its end
  ResultNeeds row_needs_;                 ///< of a row, on processes that share the run
  FallRecord falls_;                      ///< in steps in time, of the blocks of this process
  std::optional<MotionVerdict> verdict_;  ///< at the end of a stage in time
  ContactChanges changes_;                ///< of static iterations of the present stage
  std::optional<RunStatus> status_;
  std::string message_;
  std::string unsaved_;
  std::unique_ptr<const BlockPoints> points_;
  RunObservers observers_;
  std::shared_ptr<FolderRecorder> recorder_;  ///< null: none
  std::shared_ptr<CheckpointSaver> saver_;
  std::shared_ptr<const FolderClaim> claim_;
  std::optional<double> checkpoint_interval_;
  bool keeps_trials_ = false;
};

}  // namespace ashlar

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
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/results/folder/accuracy_state.hpp"
#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/folder/motion_verdict.hpp"
#include "apps/results/folder/result_folder.hpp"
#include "apps/results/folder/run_clock.hpp"
#include "apps/results/folder/run_outcome.hpp"
#include "apps/results/folder/run_status.hpp"
#include "apps/results/folder/scene_identity.hpp"
#include "apps/results/tables/block_points.hpp"
#include "apps/run/answers/answer.hpp"
#include "apps/run/run_end.hpp"
#include "apps/run/run_observer.hpp"
#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/accuracy/goal_error.hpp"
#include "solver/fracture/crack.hpp"
#include "solver/run/order_error.hpp"

namespace ashlar {

class RunFindings;
class RunHistory;
class RunPreparation;
class RunRecord;
class RunStages;
struct RunCheckpoint;

/// Options of a run.
struct RunManner {
  int threads = 1;                 ///< >= 1
  bool keeps_history = true;       ///< rows() of all steps in memory
  double began = RunClock::now();  ///< start of the wall time of a summary
  /// Processes that share the run, each with a Run of its own that its caller steps; null: none. Observers, records and
  /// rows are for the first one
  const RunRanks* ranks = nullptr;
  bool all_errors = false;  ///< a summary has the errors of the orders of all blocks, however long they take
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
  [[nodiscard]] std::optional<RunStatus> status() const { return end_.status; }
  /// Moving blocks, the answer of a search, or the reason of a failure; empty: no message.
  [[nodiscard]] const std::string& message() const { return end_.message; }
  /// Reason why the end of a failed run is not saved; empty: it is saved, or not recorded.
  [[nodiscard]] const std::string& unsaved() const { return end_.unsaved; }
  /// 1-based number of the present stage; 0: the scene has none.
  [[nodiscard]] int stage() const;
  /// Status of the present stage at its end.
  [[nodiscard]] RunStatus stage_status() const { return end_.stage; }
  /// True if a stage follows the present one, which has reached its end.
  [[nodiscard]] bool stage_follows() const;
  /// The scene of all stages, and of the present one.
  [[nodiscard]] const Scene& whole() const;
  [[nodiscard]] const Scene& scene() const;
  [[nodiscard]] const SceneIdentity& identity() const;
  /// Blocks, states, contacts, time (s, of the present stage), steps. During a search for a factor: as placed.
  [[nodiscard]] const Simulation& simulation() const;
  [[nodiscard]] const BuiltSimulation& built() const;
  /// Of a search; empty until it has ended.
  [[nodiscard]] const Answer& answer() const;

  /// Cracks of blocks so far. Their numbers are those of simulation().blocks().
  [[nodiscard]] const CrackRecord& cracks() const;
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
  [[nodiscard]] const std::vector<std::vector<double>>& rows() const;

  /// Attaches an observer, which is told that the run and its stage begin if they have begun already.
  /// @param observer not null. @throws its exceptions: it is not attached then
  void observe(std::shared_ptr<RunObserver> observer);
  /// Writes each step from the present one on into a result folder, as `ashlar run` does: frames when they are due,
  /// checkpoints, and the summary at the end. @throws ClaimRefused, std::runtime_error; std::logic_error if the run is
  /// recorded already, or has ended
  void record(const std::filesystem::path& folder, ClaimPurpose purpose = ClaimPurpose::new_run);
  /// @param claim not null but on processes other than the first, which take part in checkpoints
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
  /// Errors of the orders of all blocks, however long it takes: of a dynamic run at present, of a static analysis in
  /// equilibrium. Empty: others
  [[nodiscard]] std::vector<OrderError> order_errors() const;
  /// The same within the work that a summary may take, unless RunManner::all_errors (order_error_work.hpp).
  [[nodiscard]] OrderErrors summary_order_errors() const;
  /// `error` of summary.json with order_errors(), as JSON; "null": nothing is estimated
  [[nodiscard]] std::string errors() const;
  /// Errors of the measures of a static analysis that has ended in equilibrium, without analysis.accuracy. Empty: others
  [[nodiscard]] const std::vector<GoalError>& measure_errors() const;
  /// Choices for analysis.accuracy; null: the scene has none, or the run has not begun
  [[nodiscard]] const AccuracyState* accuracy() const;
  /// Of the last stage in time that has ended; empty: none has.
  [[nodiscard]] const std::optional<MotionVerdict>& verdict() const;
  /// summary.json, with the answer of a search; status interrupted if the run has not ended.
  [[nodiscard]] std::string summary() const;
  /// The same of a record. @param frames written so far
  [[nodiscard]] std::string summary(int frames, const LargestValues& largest) const;
  /// Position in the stages, for results.
  [[nodiscard]] const StagePlace& place() const;
  /// Writes the summary of a recorded run now.
  void write_summary() const;
  /// Writes the present state as the only frame, all rows and the summary into a result folder, replacing existing
  /// results.
  /// @throws ClaimRefused, std::runtime_error
  void write(const std::filesystem::path& folder) const;

 private:
  Run(const std::shared_ptr<const LoadedScene>& scene, const RunManner& manner);
  [[nodiscard]] bool prepares() const;
  void prepare();
  void start_record();
  void advance();
  bool begin_next_stage();
  void take_step();
  void take_iteration();
  void show_state();
  bool attempt(const std::function<void()>& step);
  bool accept_step();
  bool record_step();
  std::optional<bool> divide_cracked();
  void end_stage(RunStatus status, std::string message);
  void end_undecided();
  void interrupt();
  void end(RunStatus status);
  [[nodiscard]] FinishedStage stage_at_end(RunStatus status) const;
  [[nodiscard]] RunCheckpoint checkpoint_with(SimulationSnapshot simulation) const;

  RunClock clock_;
  RunEnd end_;
  // Parts of a run; none knows the others but from arguments.
  std::unique_ptr<RunStages> stages_;            ///< the simulation, and its place in the stages
  std::unique_ptr<RunPreparation> preparation_;  ///< before the first step; its choices and answer
  std::unique_ptr<RunHistory> history_;          ///< measures, and rows in memory
  std::unique_ptr<RunRecord> record_;            ///< observers, and the record in a folder
  std::unique_ptr<RunFindings> findings_;        ///< verdict, errors, work
  std::unique_ptr<const BlockPoints> points_;    ///< of callers
};

}  // namespace ashlar

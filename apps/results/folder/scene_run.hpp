// A scene as a run driven by its caller: step by step, stage after stage, with access to the blocks in between.
//
//   Diagnostics faults;
//   auto scene = load_scene("wall.toml", {}, faults);    // scene_loading.hpp; faults.print(std::cerr)
//   SceneRun run(std::move(*scene));
//   while (run.step()) ...                               // run.motion("brick.1", point).stress
//   run.write("wall.out");
//
// `ashlar run` adds checkpoints, progress and searches for factors of safety. A run shares no state: several may run
// at a time, each in a thread of its own.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/results/folder/contact_changes.hpp"
#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/folder/result_folder.hpp"
#include "apps/results/folder/run_clock.hpp"
#include "apps/results/folder/run_outcome.hpp"
#include "apps/results/folder/run_status.hpp"
#include "apps/results/folder/scene_identity.hpp"
#include "apps/results/tables/block_points.hpp"
#include "apps/results/tables/measure.hpp"
#include "apps/scene/build/build_simulation.hpp"
#include "apps/scene/build/scene_loading.hpp"

namespace ashlar {

class SceneRun {
 public:
  /// Builds the blocks and finds the initial equilibrium if the scene requires it.
  /// @param scene not null; not a search for a factor, which consists of many analyses. @param threads >= 1
  /// @throws std::invalid_argument "FILE:LINE:COLUMN: error: ..." if blocks cannot be built, or blocks of a static
  /// analysis are unsupported, and for invalid arguments; std::runtime_error if initial_state = "static" finds no
  /// result
  explicit SceneRun(std::shared_ptr<const LoadedScene> scene, int threads = 1)
      : SceneRun(std::move(scene), threads, RunClock::now()) {}
  explicit SceneRun(LoadedScene scene, int threads = 1)
      : SceneRun(std::make_shared<const LoadedScene>(std::move(scene)), threads) {}

  /// Takes a step, or an iteration of a static analysis. After the end of a stage, the next call starts the next one.
  /// @return true if the run has not ended
  /// @throws std::runtime_error with the reason if the step cannot be taken, or the run ends with blocks too deep in
  /// each other; the state is then the last valid one, status() is failed, and further calls throw the same; or if
  /// results cannot be written
  bool step();

  /// Empty until the run has ended.
  [[nodiscard]] std::optional<RunStatus> status() const { return status_; }
  /// Moving blocks, or the reason of a failure; empty: no message.
  [[nodiscard]] const std::string& message() const { return message_; }
  /// 1-based number of the present stage; 0: the scene has none.
  [[nodiscard]] int stage() const { return scene_->scene.stage.empty() ? 0 : place_.stage; }
  /// Blocks, states, contacts, time (s, of the present stage), steps.
  [[nodiscard]] const Simulation& simulation() const { return built_.simulation; }

  /// Index of a block in simulation().blocks(). @throws std::out_of_range if there is none of that name
  [[nodiscard]] int block(const std::string& name) const;
  /// True if a block is present in the present stage: stages remove blocks, and add others later.
  /// @param index in simulation().blocks()
  [[nodiscard]] bool present(int index) const { return simulation().system().present(index); }
  /// @throws std::logic_error with its name and that of the stage if it is absent: its state has no meaning
  void require_present(int index) const;
  /// Present motion of points of a block: place (m), displacement (m), velocity (m/s), Cauchy stress (Pa, tension
  /// positive).
  /// @param points m, of the placed, undeformed block, see BlockPoints
  /// @throws std::out_of_range; std::logic_error as require_present; std::domain_error if a point is refused
  [[nodiscard]] std::vector<PointMotion> motions(int index, const std::vector<Vector3>& points,
                                                 OutsidePoints outside = OutsidePoints::refused) const;
  [[nodiscard]] PointMotion motion(const std::string& name, const Vector3& point,
                                   OutsidePoints outside = OutsidePoints::refused) const;
  /// Multiplies a load of a block by a factor, from the next step on (Simulation::set_load_factor). A static analysis
  /// that has ended continues under the new load.
  /// @param load its number among the block's loads, from 0. @throws std::out_of_range, std::invalid_argument
  void set_load_factor(const std::string& name, int load, double factor);

  /// Names of the columns of history.csv.
  [[nodiscard]] std::vector<std::string> columns() const;
  /// Rows for the start and for each step, with the values of columns().
  [[nodiscard]] const std::vector<std::vector<double>>& rows() const { return rows_; }

  /// Writes each step from the present one on into a result folder, as `ashlar run` does: frames when they are due,
  /// and the summary at the end. @throws ClaimRefused, std::runtime_error; std::logic_error if the run is recorded
  /// already, or has ended
  void record(const std::filesystem::path& folder, ClaimPurpose purpose = ClaimPurpose::new_run);
  /// Writes the summary of a recorded run now; status interrupted if the run has not ended.
  void write_summary() const;
  /// Writes the present state as the only frame, all rows and the summary into a result folder, replacing existing
  /// results.
  /// @throws ClaimRefused, std::runtime_error
  void write(const std::filesystem::path& folder) const;

 private:
  /// @param setup_start start of the construction of the simulation, RunClock::now()
  SceneRun(std::shared_ptr<const LoadedScene> scene, int threads, double setup_start);
  void begin_next_stage();
  void reset_displacement();
  void take_step();
  void take_static_step();
  void end(RunStatus status, std::string message);
  void fail(const std::string& message);
  void add_row();
  void write_summary(const ResultFolder& results) const;
  [[nodiscard]] FinishedStage finished(RunStatus status) const;
  [[nodiscard]] std::vector<FinishedStage> begun_stages(RunStatus status) const;

  std::shared_ptr<const LoadedScene> scene_;    ///< of all stages
  std::shared_ptr<const LoadedScene> present_;  ///< the present stage
  SceneIdentity identity_;
  int threads_;
  BuiltSimulation built_;
  std::vector<Measure> measures_;
  StagePlace place_;
  std::vector<FinishedStage> finished_;  ///< completed stages; the last one may be the present one
  bool stage_has_ended_ = false;
  std::vector<std::vector<double>> rows_;
  ContactChanges changes_;  ///< of static iterations of the present stage
  std::optional<RunStatus> status_;
  std::string message_;
  RunClock clock_;
  std::unique_ptr<const BlockPoints> points_;
  std::unique_ptr<FolderClaim> claim_;     ///< of the folder of the record; null: none
  std::unique_ptr<ResultFolder> results_;  ///< in claim_
};

}  // namespace ashlar

// The simulation of a run, stage after stage. A scene without stages is one stage.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/results/folder/result_folder.hpp"
#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/folder/run_outcome.hpp"
#include "apps/results/folder/scene_identity.hpp"
#include "apps/results/tables/measure.hpp"
#include "apps/run/run_group.hpp"
#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/fracture/cracked_blocks.hpp"

namespace ashlar {

class RunStages {
 public:
  /// Next step of a stage.
  enum class Next {
    first_step,  ///< of the present stage
    step,        ///< further ones; also after the end of the last stage
    next_stage,  ///< the present one has ended, and another follows
  };

  /// @param whole scene of all stages, not null. @param first built for its first stage (run_setup.hpp). @param threads >= 1
  RunStages(std::shared_ptr<const LoadedScene> whole, BuiltSimulation first, int threads,
            const RunGroup& group);

  [[nodiscard]] Next next() const { return next_; }
  /// The first step of the present stage comes.
  void enter() { next_ = Next::step; }
  /// Ends the present stage. @param done true: as it should. @return true if another stage follows
  bool end(bool done);
  /// Steps of a stage that has ended continue.
  void reopen();
  /// Begins the stage that follows, with the state of the present one.
  /// @param last end of the present stage. @return reason why it cannot begin: the present one remains then; empty: it has
  /// begun. Collective
  [[nodiscard]] std::optional<std::string> begin_next(const FinishedStage& last);

  /// Builds the present stage again, as placed. Collective. @throws std::runtime_error if its blocks cannot be built
  void rebuild(const TrialFactors& factors = {});
  /// The same with orders and sub-faces of a choice, of this process alone.
  void rebuild(const AccuracyState& choice);
  /// Goes to the stage and state of a checkpoint of the same scene. Collective.
  /// @throws std::invalid_argument if it has passed the scene's end_time, std::runtime_error
  void resume(const RunCheckpoint& checkpoint);
  /// Divides blocks that have cracked, in a static analysis at the balance of a load level. @return true if there are any. @throws std::length_error as CrackedBlocks::divide
  bool divide_cracked();
  /// Time that the next load level may reach, s: end_time, or that at which a block is expected to crack.
  [[nodiscard]] double end_of_loads() const;
  /// True once after resume(): a checkpoint is written after a step, and before the blocks that it has brought to their strength
  /// are divided.
  [[nodiscard]] bool cracks_are_due();
  /// Empty if no block cracks.
  [[nodiscard]] const CrackRecord& cracks() const;
  /// Displacements in results count from the present state. @param measures of the whole scene
  void reset_displacement(const std::vector<Measure>& measures);

  /// Puts all results of all processes together on the first one; nothing without others. Collective.
  void gather();
  /// The same with what files need. @param due the same on all processes; nothing: without counts of contacts
  void gather(const ResultNeeds& needs, ResultFolder::Due due);

  /// The scene of all stages, and of the present one.
  [[nodiscard]] const std::shared_ptr<const LoadedScene>& loaded() const { return whole_; }
  [[nodiscard]] const Scene& whole() const { return whole_->scene; }
  [[nodiscard]] const Scene& scene() const { return present_->scene; }
  [[nodiscard]] const SceneIdentity& identity() const { return identity_; }
  [[nodiscard]] const BuiltSimulation& built() const { return built_; }
  [[nodiscard]] const Simulation& simulation() const { return built_.simulation; }
  [[nodiscard]] Simulation& simulation() { return built_.simulation; }
  /// Place of the present stage, for results.
  [[nodiscard]] const StagePlace& place() const { return place_; }
  /// 1-based number of the present stage; 0: the scene has none.
  [[nodiscard]] int number() const { return whole().stage.empty() ? 0 : place_.stage; }
  /// The stages before the present one.
  [[nodiscard]] const std::vector<FinishedStage>& finished() const { return finished_; }
  [[nodiscard]] int threads() const { return threads_; }
  [[nodiscard]] const RunGroup& group() const { return group_; }

 private:
  std::shared_ptr<const LoadedScene> whole_;
  std::shared_ptr<const LoadedScene> present_;
  SceneIdentity identity_;  ///< of the whole scene
  int threads_;
  RunGroup group_;
  BuiltSimulation built_;
  Next next_ = Next::first_step;
  StagePlace place_;
  std::vector<FinishedStage> finished_;
  std::unique_ptr<CrackedBlocks> cracks_;  ///< null: no block of the scene cracks
  bool cracks_are_due_ = false;
};

}  // namespace ashlar

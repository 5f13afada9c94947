// The search for an answer before a run shows a motion: a factor by limit analysis, by static analyses or by both, thrust
// and movements of supports, or a pushover (notes/factor_of_safety.md).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "apps/results/folder/folder_claim.hpp"
#include "apps/run/answers/answer.hpp"
#include "apps/run/answers/trial_folder.hpp"
#include "apps/run/answers/trial_run.hpp"
#include "apps/run/run_group.hpp"
#include "apps/run/run_observer.hpp"
#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/scene_loading.hpp"

namespace ashlar {

/// Storage of static analyses of a search.
struct TrialStorage {
  std::shared_ptr<const FolderClaim> claim;  ///< null: none
  bool resume = false;                       ///< with the trials that the folder holds
  std::optional<double> interval;            ///< s between states; empty: growing, see CheckpointSchedule
};

/// All members but plain values are collective. Limit analysis, thrust and pushovers are work of the first process, which makes a
/// simulation of all blocks for them; static analyses are shared. All processes get the answer.
class AnswerSearch {
 public:
  /// @param scene not null, with a search. @param hash of the scene (scene_identity.hpp)
  /// @param placed blocks as placed, without factors. @param threads >= 1
  /// @param storage of the first process
  /// @throws std::runtime_error if blocks cannot be built
  AnswerSearch(std::shared_ptr<const LoadedScene> scene, std::uint64_t hash, const Simulation& placed,
               int threads, TrialStorage storage, const RunGroup& group = {});

  /// Takes a piece of the search: all of limit analysis, of an analysis of thrust or of a pushover, or an iteration of a
  /// trial.
  /// @param placed as above. @return true if there is more to do
  /// @throws std::runtime_error with path and reason if a trial cannot be stored
  bool advance(const Simulation& placed, const RunObservers& observers);

  [[nodiscard]] bool interrupted() const { return !interrupted_.empty(); }
  /// "interrupted after 3 static analyses, ..."; empty: it was not. On the first process complete.
  [[nodiscard]] const std::string& message() const { return interrupted_; }
  /// Complete once there is nothing more to do and the search was not interrupted.
  [[nodiscard]] const Answer& answer() const { return answer_; }

 private:
  struct Plan {
    bool limits_first = false;  ///< limit analysis comes before static analyses
    bool by_limits = false;     ///< it answers alone
    std::string reason;         ///< of the method; empty: the scene names it, or it was told
  };
  [[nodiscard]] Plan planned(const Simulation& placed);
  [[nodiscard]] bool may_continue(const RunObservers& observers) const;
  bool find_limits_first(const Simulation& placed, const RunObservers& observers);
  bool find_thrust_first(const Simulation& placed, const RunObservers& observers);
  bool find_pushover_first(const Simulation& placed, const RunObservers& observers);
  bool advance_trial(const RunObservers& observers);
  bool begin_trial(const RunObservers& observers);
  void save_trial();
  void store_result();
  void add(const FactorTrial& trial, const std::string& reason, const RunObservers& observers);
  void interrupt_trial(const RunObservers& observers);

  std::shared_ptr<const LoadedScene> scene_;
  std::uint64_t hash_;
  int threads_;
  TrialStorage storage_;
  RunGroup group_;
  /// Of a shared run, on the first process: all blocks, until the next two are known
  std::optional<BuiltSimulation> whole_;
  std::optional<RigidModel> model_;  ///< until limit analysis, thrust or a pushover has used it
  Plan plan_;
  std::optional<FactorSearch> search_;
  bool stores_ = false;                  ///< trials are stored
  std::unique_ptr<TrialFolder> trials_;  ///< null: not stored, or by another process
  std::optional<TrialRun> trial_;        ///< the present one
  Answer answer_;
  std::string interrupted_;
};

/// True if the analysis consists of such a search.
[[nodiscard]] bool seeks_answer(const SceneAnalysis& analysis);

}  // namespace ashlar

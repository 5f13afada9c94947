// The search for an answer before a run shows a motion: a factor by limit analysis, by static analyses or by both, or
// thrust and movements of supports (notes/factor_of_safety.md).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "apps/results/folder/folder_claim.hpp"
#include "apps/run/answer.hpp"
#include "apps/run/run_observer.hpp"
#include "apps/run/trial_folder.hpp"
#include "apps/run/trial_run.hpp"
#include "apps/scene/build/scene_loading.hpp"

namespace ashlar {

/// Storage of static analyses of a search.
struct TrialStorage {
  std::shared_ptr<const FolderClaim> claim;  ///< null: none
  bool resume = false;                       ///< with the trials that the folder holds
  std::optional<double> interval;            ///< s between states; empty: growing, see CheckpointSchedule
};

class AnswerSearch {
 public:
  /// @param scene not null, with a search. @param hash of the scene (scene_identity.hpp)
  /// @param placed blocks as placed, without factors. @param threads >= 1
  AnswerSearch(std::shared_ptr<const LoadedScene> scene, std::uint64_t hash, const Simulation& placed,
               int threads, TrialStorage storage);

  /// Takes a piece of the search: all of limit analysis, all of an analysis of thrust, or an iteration of a trial.
  /// @param placed as above. @return true if there is more to do
  /// @throws std::runtime_error with path and reason if a trial cannot be stored
  bool advance(const Simulation& placed, const RunObservers& observers);

  [[nodiscard]] bool interrupted() const { return !interrupted_.empty(); }
  /// "interrupted after 3 static analyses, ..."; empty: it was not.
  [[nodiscard]] const std::string& message() const { return interrupted_; }
  /// Complete once there is nothing more to do and the search was not interrupted.
  [[nodiscard]] const Answer& answer() const { return answer_; }

 private:
  bool find_limits_first(const RunObservers& observers);
  bool find_thrust_first(const Simulation& placed, const RunObservers& observers);
  bool advance_trial(const RunObservers& observers);
  bool begin_trial(const RunObservers& observers);
  void add(const FactorTrial& trial, const std::string& reason, const RunObservers& observers);
  void interrupt_trial(const RunObservers& observers);

  std::shared_ptr<const LoadedScene> scene_;
  std::uint64_t hash_;
  int threads_;
  TrialStorage storage_;
  std::optional<RigidModel> model_;  ///< until limit analysis or thrust has used it
  bool by_limits_;                   ///< limit analysis answers alone
  std::optional<FactorSearch> search_;
  std::unique_ptr<TrialFolder> trials_;  ///< null: not stored
  std::optional<TrialRun> trial_;        ///< the present one
  Answer answer_;
  std::string interrupted_;
};

/// True if the analysis consists of such a search.
[[nodiscard]] bool seeks_answer(const SceneAnalysis& analysis);

}  // namespace ashlar

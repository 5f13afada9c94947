// The files of a search for a factor in its result folder: complete trials, and the state of the present one, from
// which an interrupted search is continued.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/run/answers/factor_search.hpp"
#include "apps/run/checkpoint_schedule.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

inline constexpr const char* trials_name = "factor_trials.json";            ///< complete trials
inline constexpr const char* trial_state_name = "factor_trial.checkpoint";  ///< state of the present one

/// True if a folder holds a search that was interrupted before its motion was shown.
[[nodiscard]] bool holds_open_search(const std::filesystem::path& folder, const Scene& scene);

/// Members throw std::runtime_error with path and reason if a file cannot be written.
class TrialFolder {
 public:
  /// Reads complete trials. @param scene its hash (scene_identity.hpp). @param resume false: earlier files are removed
  /// @param interval s between states; empty: growing, see CheckpointSchedule
  /// @throws std::runtime_error if the file of trials is damaged or belongs to another scene
  TrialFolder(std::shared_ptr<const FolderClaim> claim, std::uint64_t scene, bool resume,
              std::optional<double> interval);

  /// Trial of a factor, if it is stored.
  [[nodiscard]] std::optional<FactorTrial> find(double factor) const;
  /// Begins a trial. @return its state, if it was interrupted; empty without one of this scene and factor
  [[nodiscard]] std::optional<RunCheckpoint> begin(double factor);
  /// True if the state of the trial is to be saved now.
  [[nodiscard]] bool due() const;
  void save(double factor, const RunCheckpoint& state);
  /// Stores a complete trial in place of its state.
  void add(const FactorTrial& trial);

 private:
  [[nodiscard]] std::uint64_t hash_of(double factor) const;

  std::shared_ptr<const FolderClaim> claim_;
  std::uint64_t scene_;
  std::filesystem::path trials_path_, state_path_;
  std::vector<FactorTrial> trials_;
  CheckpointSchedule schedule_;
};

}  // namespace ashlar

// The files of a search for a factor in its result folder: complete trials, and the state of the present one, from
// which an interrupted search is continued.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "apps/results/folder/folder_claim.hpp"
#include "apps/run/checkpoint_schedule.hpp"
#include "apps/run/trial_run.hpp"

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
  /// Restores the state of an interrupted trial; without one of this scene and factor the trial remains as it is.
  void begin(TrialRun& trial);
  void save_if_due(const TrialRun& trial);
  void save(const TrialRun& trial) const;
  /// Stores a complete trial in place of its state.
  void add(const FactorTrial& trial);

 private:
  [[nodiscard]] std::uint64_t hash_of(double factor) const;

  std::shared_ptr<const FolderClaim> claim_;
  std::uint64_t scene_;
  std::optional<double> interval_;
  std::filesystem::path trials_path_, state_path_;
  std::vector<FactorTrial> trials_;
  CheckpointSchedule schedule_;
};

}  // namespace ashlar

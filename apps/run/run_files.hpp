// The files of a run in its result folder: tables and frames, checkpoints, the summary, and reserved disk space.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/folder/result_folder.hpp"
#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/folder/run_summary.hpp"
#include "apps/run/space_reserve.hpp"
#include "apps/scene/build/scene_loading.hpp"

namespace ashlar {

constexpr const char* checkpoint_name = "checkpoint";
constexpr const char* trials_name = "factor_trials.json";  ///< of a search for a factor

/// Wall time from any origin, s.
[[nodiscard]] double seconds_now();

/// All members throw std::runtime_error with path and reason if the folder no longer exists or cannot be written.
class RunFiles {
 public:
  /// @param loaded the whole scene; must outlive this, as must the claim. @param identity of the scene
  /// @param simulation at the start of the run, or at the checkpoint
  /// @param earlier null: a new run. @param start seconds_now() when the program began
  RunFiles(const LoadedScene& loaded, SceneIdentity identity, const FolderClaim& claim,
           const Simulation& simulation, const RunCheckpoint* earlier, double start);

  /// To be called before the first step: ends the time of setup.
  void note_setup() { seconds_.setup = seconds_now() - start_; }

  void add_step(const Simulation& simulation);
  [[nodiscard]] ResultFolder& tables() { return tables_; }
  [[nodiscard]] const ResultFolder& tables() const { return tables_; }

  /// True if a state has so many more contact points than the last checkpoint that the reserved space may be too
  /// small.
  [[nodiscard]] bool outgrown(const Simulation& simulation) const;
  /// Writes a checkpoint and reserves space for the next one and a summary.
  void save(const SimulationSnapshot& state, const std::vector<FinishedStage>& stages,
            const ContactChanges& changes);
  /// Writes a checkpoint into the reserved space, for a full disk.
  void save_in_reserve(const SimulationSnapshot& state, const std::vector<FinishedStage>& stages,
                       const ContactChanges& changes);
  void write_summary(const nlohmann::ordered_json& summary) const;
  /// Writes the summary into the reserved space.
  void write_summary_in_reserve(const nlohmann::ordered_json& summary);

  /// Times of all sessions of the run so far.
  [[nodiscard]] RunSeconds seconds() const;
  [[nodiscard]] const SceneIdentity& identity() const { return identity_; }
  void add_output_seconds(double seconds) { seconds_.output += seconds; }

 private:
  void write_state(const SimulationSnapshot& state, const std::vector<FinishedStage>& stages,
                   const ContactChanges& changes);

  const FolderClaim& claim_;
  double start_;
  SceneIdentity identity_;
  SpaceReserve reserve_;
  ResultFolder tables_;
  std::uintmax_t scene_bytes_;      ///< in the summary
  std::uintmax_t state_bytes_ = 0;  ///< of the last checkpoint
  std::size_t contact_points_ = 0;  ///< of the last checkpoint
  RunSeconds earlier_seconds_;
  RunSeconds seconds_;
};

}  // namespace ashlar

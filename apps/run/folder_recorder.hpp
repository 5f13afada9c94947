// Observer that records a run in its result folder: tables, frames, drawings and the summary.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/folder/result_folder.hpp"
#include "apps/results/system/space_reserve.hpp"
#include "apps/run/run_observer.hpp"

namespace ashlar {

/// All members throw std::runtime_error with path and reason if the folder no longer exists or cannot be written.
class FolderRecorder : public RunObserver {
 public:
  /// @param claim not null. @param earlier state of the files from which the record is continued; empty: a new one
  explicit FolderRecorder(std::shared_ptr<const FolderClaim> claim,
                          std::optional<ResultFolderState> earlier = {});

  void run_begins(const Run& run) override;
  void stage_begins(const Run& run) override;
  void step_taken(const Run& run) override;
  void blocks_crack(const Run& run) override;
  void stage_ends(const Run& run) override;
  void run_ends(const Run& run) override;
  void save_after_failure(const Run& run) override;

  /// Results that need the last accepted step. @pre begun()
  [[nodiscard]] ResultFolder::Due due(const Run& run) const;
  /// True once the run has begun: the files below exist then.
  [[nodiscard]] bool begun() const { return files_.has_value(); }
  /// Waits until the tables are on the disk. @pre begun()
  [[nodiscard]] ResultFolderState synced_state();
  [[nodiscard]] int frames() const { return files_ ? files_->frames() : 0; }
  /// @pre begun()
  [[nodiscard]] LargestValues largest(const Simulation& simulation) const {
    return files_->largest(simulation);
  }
  /// Adds `peaks` of the measures, if there are any.
  void add_peaks(nlohmann::ordered_json& summary) const;
  void write_summary(const Run& run) const;

  [[nodiscard]] const FolderClaim& claim() const { return *claim_; }
  /// Disk space kept for the last files, on the folder's file system.
  [[nodiscard]] SpaceReserve& reserve() { return reserve_; }

 private:
  std::shared_ptr<const FolderClaim> claim_;
  std::optional<ResultFolderState> earlier_;
  SpaceReserve reserve_;
  std::optional<ResultFolder> files_;
  int stage_ = 0;  ///< to which the files have come
};

}  // namespace ashlar

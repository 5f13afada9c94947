// Observer that saves the state of a recorded run: at the start of each stage, when it is due, and at the end. Disk space
// for the next state and the summary is kept, so that a full disk does not take the state that a run has reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "apps/run/checkpoint_schedule.hpp"
#include "apps/run/folder_recorder.hpp"
#include "apps/run/run_group.hpp"
#include "apps/run/run_observer.hpp"

namespace ashlar {

/// All members throw std::runtime_error with path and reason if the state cannot be written.
class CheckpointSaver : public RunObserver {
 public:
  /// @param recorder attached before this; null on processes that do not write. @param interval s between checkpoints, >= 0;
  /// empty: growing, see CheckpointSchedule. @param saved the folder has a checkpoint of the run
  /// @param group each process has a saver, whose members are collective
  CheckpointSaver(std::shared_ptr<FolderRecorder> recorder, std::optional<double> interval, bool saved,
                  const RunGroup& group = {});

  void run_begins(const Run& run) override;
  void stage_begins(const Run& run) override;
  void step_taken(const Run& run) override;
  void stage_stops(const Run& run) override;
  void save_after_failure(const Run& run) override;

  /// True if the folder has a checkpoint of this run.
  [[nodiscard]] bool saved() const { return saved_; }

 private:
  /// Writes a checkpoint and reserves space for the next one.
  void save(const Run& run);
  void write(const Run& run);
  /// Of a state with so many contact points, bytes.
  [[nodiscard]] std::uintmax_t expected_bytes(std::size_t contact_points) const;
  /// By which writing such a state is expected to take longer than writing the last one, s.
  [[nodiscard]] double expected_growth(std::size_t contact_points) const;
  void reserve_for(std::size_t contact_points);

  std::shared_ptr<FolderRecorder> recorder_;
  RunGroup group_;
  bool saved_;
  CheckpointSchedule schedule_;
  std::uintmax_t scene_bytes_ = 0;   ///< in the summary
  std::uintmax_t state_bytes_ = 0;   ///< of the last checkpoint
  std::size_t contact_points_ = 0;   ///< of the last checkpoint
  std::size_t reserved_points_ = 0;  ///< contact points of the state that space was reserved for
};

}  // namespace ashlar

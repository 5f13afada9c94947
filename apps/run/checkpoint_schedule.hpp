// Schedule of a run's checkpoints, by wall time.
#pragma once

#include <algorithm>
#include <optional>

namespace ashlar {

/// Due 1 s after the start, then at intervals that double up to 60 s, or at a fixed interval. A short run that is
/// killed loses little, and a long one does not write all the time.
class CheckpointSchedule {
 public:
  static constexpr double first_interval = 1.0;     ///< s
  static constexpr double longest_interval = 60.0;  ///< s: largest loss of a run that is killed

  /// @param interval s, >= 0; 0: after every step. @param now s, wall time
  CheckpointSchedule(std::optional<double> interval, double now)
      : fixed_(interval), interval_(interval.value_or(first_interval)), saved_at_(now) {}

  [[nodiscard]] bool due(double now) const { return now - saved_at_ >= interval_; }

  /// To be called when a checkpoint that was due is written; the next interval starts then.
  void saved(double now) {
    saved_at_ = now;
    if (!fixed_) interval_ = std::min(2.0 * interval_, longest_interval);
  }

 private:
  std::optional<double> fixed_;
  double interval_;
  double saved_at_;
};

}  // namespace ashlar

// When a run saves itself, by wall time.
#pragma once

#include <algorithm>
#include <optional>

namespace ashlar {

/// Due 1 s after the start, then after 2, 4, ... s up to 60 s more each, so that a short run that is killed
/// loses little and a long one does not write all the time; or at a fixed distance.
class CheckpointSchedule {
 public:
  static constexpr double first_interval = 1.0;     ///< s
  static constexpr double longest_interval = 60.0;  ///< s: what a run that is killed loses at most

  /// @param interval s, >= 0; 0: after every step. @param now s, wall time
  CheckpointSchedule(std::optional<double> interval, double now)
      : fixed_(interval), interval_(interval.value_or(first_interval)), saved_at_(now) {}

  [[nodiscard]] bool due(double now) const { return now - saved_at_ >= interval_; }

  /// To be told when a checkpoint that was due is written; the next one counts from there.
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

// Schedule of a run's checkpoints, by wall time.
#pragma once

#include <algorithm>
#include <optional>

namespace ashlar {

/// At a fixed interval, or due 1 s after the start and then at intervals that double up to 60 s, but only while all
/// checkpoints, this one and the one at the end included, take at most 3 % of the time since the start. A short run that is
/// killed loses little, and a run of large states does not write all the time.
class CheckpointSchedule {
 public:
  static constexpr double first_interval = 1.0;  ///< s
  static constexpr double longest_interval =
      60.0;                                      ///< s: largest loss of a killed run whose states are small
  static constexpr double largest_share = 0.03;  ///< of the time since the start

  /// @param interval s, >= 0, kept whatever it costs; 0: after every step. @param now s, wall time, at the start
  CheckpointSchedule(std::optional<double> interval, double now)
      : fixed_(interval), interval_(interval.value_or(first_interval)), started_at_(now), saved_at_(now) {}

  /// @param growth s, >= 0, by which the next checkpoint is expected to take longer than the last one
  [[nodiscard]] bool due(double now, double growth = 0.0) const {
    if (now - saved_at_ < interval_) return false;
    const double next = last_ + growth;
    return fixed_ || spent_ + 2.0 * next <= largest_share * (now - started_at_);
  }

  /// To be called when a checkpoint, due or not, is written; the next interval starts then. @param began,ended s
  void saved(double began, double ended) {
    last_ = ended - began;
    spent_ += last_;
    saved_at_ = ended;
    if (!fixed_) interval_ = std::min(2.0 * interval_, longest_interval);
  }

  /// Intervals begin again, with a stage or a trial of a search.
  void begin(double now) {
    saved_at_ = now;
    if (!fixed_) interval_ = first_interval;
  }

 private:
  std::optional<double> fixed_;
  double interval_;
  double started_at_;
  double saved_at_;
  double last_ = 0.0;   ///< s that the last checkpoint took
  double spent_ = 0.0;  ///< s that all took
};

}  // namespace ashlar

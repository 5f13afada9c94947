// Simulated time. It is counted in whole steps from where the length of the steps last changed, so that
// rounding does not add up: after n steps of length dt from t0 it is t0 + n dt, rounded once. Lengths are
// taken for the decimal numbers that they are written as: 3 steps of 0.1 s end at 0.3 s, not at the next
// double, which three times the double that stands for 0.1 is.
#pragma once

#include <cstdint>

namespace ashlar {

/// start + count x step, rounded once where the shortest decimal numbers that read back as `start` and `step`
/// and their sum fit in 53 bits of a common decimal place; else with the rounding of a product and a sum.
[[nodiscard]] double decimal_sum(double start, std::int64_t count, double step);

/// A time and how it was reached.
struct StepClock {
  double start = 0.0;      ///< s, where steps of the present length began
  double step = 0.0;       ///< s, their length; 0: none was taken since `start`
  std::int64_t count = 0;  ///< of these steps

  /// s
  [[nodiscard]] double time() const;
  /// What time() is after a step of this length, s; after one of 0 s the present time.
  [[nodiscard]] double time_after(double length) const;
  void advance(double length);
};

/// What is left up to a time is nothing but rounding if it is at most this, s: less than 1e-9 of a step, or the
/// rounding of times near it. It is no step of its own.
[[nodiscard]] double time_rounding(double time_step, double end_time);

}  // namespace ashlar

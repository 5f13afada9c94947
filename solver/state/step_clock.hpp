// Simulated time. It is counted in whole steps since the last change of the step length, so that rounding errors do
// not accumulate: after n steps of length dt from t0 it is t0 + n dt, rounded once. Lengths are interpreted as the
// decimal numbers they are written as: 3 steps of 0.1 s end at 0.3 s, not at the next double, which is three times
// the double closest to 0.1.
#pragma once

#include <cstdint>

namespace ashlar {

/// start + count x step, rounded once if the shortest decimal representations of `start` and `step` and their sum fit
/// in 53 bits of a common decimal place; otherwise with the rounding of a product and a sum.
[[nodiscard]] double decimal_sum(double start, std::int64_t count, double step);

/// A time and how it was reached.
struct StepClock {
  double start = 0.0;      ///< s, where steps of the present length began
  double step = 0.0;       ///< s, their length; 0: none since `start`
  std::int64_t count = 0;  ///< of these steps

  /// s
  [[nodiscard]] double time() const;
  /// time() after a step of this length, s; for 0 s the present time.
  [[nodiscard]] double time_after(double length) const;
  void advance(double length);
};

/// Largest remaining time that is within rounding error, s: less than 1e-9 of a step, or the rounding of times near
/// `end_time`. It does not need a step of its own.
[[nodiscard]] double time_rounding(double time_step, double end_time);

}  // namespace ashlar

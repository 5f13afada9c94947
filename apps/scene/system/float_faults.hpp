// Faults of arithmetic, which processors count without ending a program.
#pragma once

namespace ashlar {

struct FloatFaults {
  bool division = false;  ///< a number other than zero by zero
  bool invalid = false;   ///< no number, as of 0 / 0 or the root of -1
  bool overflow = false;
  [[nodiscard]] bool any() const { return division || invalid || overflow; }
};

void forget_float_faults();

/// Faults of this thread since it last forgot them; where a system does not count them, those that the result shows.
[[nodiscard]] FloatFaults float_faults(double result);

}  // namespace ashlar

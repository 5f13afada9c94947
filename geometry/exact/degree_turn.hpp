// Sine and cosine of an angle in degrees, exact at multiples of 90, and of the same size at odd multiples of
// 45.
#pragma once

namespace ashlar {

struct DegreeTurn {
  double sine = 0.0;
  double cosine = 1.0;
};

[[nodiscard]] DegreeTurn degree_turn(double degrees);

}  // namespace ashlar

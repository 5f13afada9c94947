// Angles in degrees whose sines and cosines are rounded to the nearest double: exact at multiples of 90, of the same size
// at odd multiples of 45.
#pragma once

namespace ashlar {

/// Sine and cosine of an angle.
struct DegreeTurn {
  double sine = 0.0;
  double cosine = 1.0;
};

[[nodiscard]] DegreeTurn degree_turn(double degrees);

/// The angle of (x, y) from x towards y, above -180 to 180; exact at multiples of 45; 0 for no direction.
[[nodiscard]] double degrees_of(double x, double y);

}  // namespace ashlar

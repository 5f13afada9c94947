// Angles in degrees whose sines and cosines are exact at multiples of 90.
#pragma once

namespace ashlar {

/// Sine and cosine of an angle.
struct Turn {
  double sine;
  double cosine;
};

/// Exact (0, 1, -1) at multiples of 90.
[[nodiscard]] Turn turn_of(double degrees);

/// The angle of (x, y) from x towards y, -180 to 180; exact on the axes.
[[nodiscard]] double degrees_of(double x, double y);

}  // namespace ashlar

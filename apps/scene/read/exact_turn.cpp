#include "apps/scene/read/exact_turn.hpp"

#include <cmath>
#include <numbers>

namespace ashlar {

Turn turn_of(double degrees) {
  int quarters = 0;
  const double rest = std::remquo(degrees, 90.0, &quarters) * std::numbers::pi / 180.0;
  const double sine = std::sin(rest), cosine = std::cos(rest);
  // remquo returns at least the three low bits of the quotient, with its sign.
  switch (quarters & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

double degrees_of(double x, double y) {
  if (y == 0.0) return x >= 0.0 ? 0.0 : 180.0;
  if (x == 0.0) return y > 0.0 ? 90.0 : -90.0;
  return std::atan2(y, x) * 180.0 / std::numbers::pi;
}

}  // namespace ashlar

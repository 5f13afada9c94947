#include "geometry/exact/degree_turn.hpp"

#include <cmath>
#include <numbers>

namespace ashlar {

DegreeTurn degree_turn(double degrees) {
  int quarters = 0;
  const double rest_degrees = std::remquo(degrees, 90.0, &quarters);
  const double rest = rest_degrees * std::numbers::pi / 180.0;
  const bool half = std::abs(rest_degrees) == 45.0;  // sine and cosine are equal
  const double sine = half ? std::copysign(std::sqrt(0.5), rest) : std::sin(rest);
  const double cosine = half ? std::sqrt(0.5) : std::cos(rest);
  // remquo gives at least the three low bits of the quotient, with its sign.
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

}  // namespace ashlar

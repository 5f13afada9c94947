#include "geometry/exact/degree_turn.hpp"

#include <cmath>
#include <numbers>

namespace ashlar {

DegreeTurn degree_turn(double degrees) {
  int quarters = 0;
  const double rest = std::remquo(degrees, 90.0, &quarters) * std::numbers::pi / 180.0;
  const double sine = std::sin(rest), cosine = std::cos(rest);
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

#include "geometry/exact/degree_turn.hpp"

#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {

DegreeTurn degree_turn(double degrees) {
  return {correctly_rounded::sin_of_degrees(degrees), correctly_rounded::cos_of_degrees(degrees)};
}

double degrees_of(double x, double y) {
  if (y == 0.0) return x >= 0.0 ? 0.0 : 180.0;  // whatever the signs of zeros
  return correctly_rounded::degrees_of_atan2(y, x);
}

}  // namespace ashlar

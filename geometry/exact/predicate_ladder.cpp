#include "geometry/exact/predicate_ladder.hpp"

#include <cmath>

namespace ashlar {

void NumericRange::include(double coordinate) {
  if (coordinate == 0.0) return;
  int exponent = 0;
  double mantissa = std::frexp(std::abs(coordinate), &exponent);
  highest_bit = std::max(highest_bit, exponent);
  const auto digits = static_cast<unsigned long long>(mantissa * 0x1p53);
  lowest_bit = std::min(lowest_bit, exponent - 53 + __builtin_ctzll(digits));
}

void NumericRange::include(const NumericRange& other) {
  lowest_bit = std::min(lowest_bit, other.lowest_bit);
  highest_bit = std::max(highest_bit, other.highest_bit);
}

}  // namespace ashlar

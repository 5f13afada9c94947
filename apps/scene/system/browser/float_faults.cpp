// WebAssembly does not count faults: one whose number does not reach the result, as in 1 / (1 / 0), is not found.
#include "apps/scene/system/float_faults.hpp"

#include <cmath>

namespace ashlar {

void forget_float_faults() {}

FloatFaults float_faults(double result) {
  return {.invalid = std::isnan(result), .overflow = std::isinf(result)};
}

}  // namespace ashlar

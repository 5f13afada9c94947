#include "apps/scene/system/float_faults.hpp"

#include <cfenv>

namespace ashlar {

void forget_float_faults() {
  std::feclearexcept(FE_ALL_EXCEPT);
}

FloatFaults float_faults(double /*result*/) {
  const int raised = std::fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
  return {.division = (raised & FE_DIVBYZERO) != 0,
          .invalid = (raised & FE_INVALID) != 0,
          .overflow = (raised & FE_OVERFLOW) != 0};
}

}  // namespace ashlar

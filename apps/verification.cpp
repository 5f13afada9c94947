#include "apps/verification.hpp"

#include <cmath>

namespace ashlar {

VerificationCheck check_relative(std::string what, double measured, double reference, double tolerance) {
  return {std::move(what), measured, reference, std::abs(measured - reference) / std::abs(reference),
          tolerance};
}

VerificationCheck check_absolute(std::string what, double measured, double reference, double tolerance) {
  return {std::move(what), measured, reference, std::abs(measured - reference), tolerance};
}

}  // namespace ashlar

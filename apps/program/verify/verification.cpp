#include "apps/program/verify/verification.hpp"

#include <cmath>

namespace ashlar {

VerificationCheck check_relative(std::string what, double measured, double reference, double tolerance) {
  return {std::move(what), measured, reference, std::abs(measured - reference) / std::abs(reference),
          tolerance};
}

VerificationCheck check_absolute(std::string what, double measured, double reference, double tolerance) {
  return {std::move(what), measured, reference, std::abs(measured - reference), tolerance};
}

std::vector<VerificationCase> all_verification_cases() {
  std::vector<VerificationCase> cases;
  for (const auto& group :
       {kinematics_cases(), contact_spring_cases(), non_convex_cases(), hertz_cases(), tunnel_cases(),
        record_cases(), cutting_cases(), peer_cases(), falling_block_cases()})
    cases.insert(cases.end(), group.begin(), group.end());
  return cases;
}

}  // namespace ashlar

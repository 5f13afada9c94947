// Hertz's contact with the reference settings.
#include <cmath>

#include "apps/program/verify/hertz_sphere.hpp"
#include "apps/program/verify/verification.hpp"

namespace ashlar {
namespace {

/// The compression of the springs, p0/kn, is 2.5 % of the approach.
std::vector<VerificationCheck> hertz_sphere() {
  const HertzSphere sphere;
  const HertzContact contact = press(sphere);
  const auto found = [&](double value) { return contact.equilibrium ? value : std::nan(""); };
  return {check_relative("radius of contact of the formula, m", sphere.contact_radius(), 9.916e-4, 1e-4),
          check_relative("force on the plane, N", found(contact.force), 1000.0, 1e-5),
          check_relative("radius of contact, m", found(contact.radius), 9.916e-4, 0.05),
          check_relative("approach, m", found(contact.approach), 9.833e-6, 0.05),
          check_relative("peak pressure, Pa", found(contact.peak_pressure), 485.6e6, 0.05)};
}

constexpr VerificationCase hertz_case_list[] = {
    {"hertz-sphere", "a sphere on a rigid plane, of graded tied blocks", hertz_sphere},
};

}  // namespace

std::span<const VerificationCase> hertz_cases() {
  return hertz_case_list;
}

}  // namespace ashlar

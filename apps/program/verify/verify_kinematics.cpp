#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/program/verify/verification.hpp"
#include "mechanics/basis/moments.hpp"

namespace ashlar {
namespace {

std::vector<VerificationCheck> moments_tetrahedron() {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                          {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 2, 3}}}};
  constexpr int degree = 24;
  const auto values = moments(mesh, degree);
  const auto factorial = [](int k) { return std::tgamma(k + 1.0); };
  double worst = 0.0;
  for (const auto& [a, b, c] : monomial_exponents(degree)) {
    const double exact = factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3);
    const double value = values[static_cast<std::size_t>(monomial_index(a, b, c))];
    worst = std::max(worst, std::abs(value - exact) / exact);
  }
  return {check_absolute("largest relative error, a + b + c <= 24", worst, 0.0, 1e-14)};
}

constexpr VerificationCase kinematics_case_list[] = {
    {"moments-tetrahedron", "moments of the unit tetrahedron against a! b! c! / (a+b+c+3)!",
     moments_tetrahedron},
};

}  // namespace

std::span<const VerificationCase> kinematics_cases() {
  return kinematics_case_list;
}

}  // namespace ashlar

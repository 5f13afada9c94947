// Verification cases: what `ashlar verify` runs. Each compares numbers of this program with references that
// do not come from it: formulas, or values computed independently.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace ashlar {

/// One comparison.
struct VerificationCheck {
  std::string what;
  double measured;
  double reference;
  double error;      ///< as compared with the tolerance: relative to the reference, or absolute
  double tolerance;  ///< error <= tolerance passes
  [[nodiscard]] bool passed() const { return error <= tolerance; }
};

/// |measured - reference| / |reference|.
[[nodiscard]] VerificationCheck check_relative(std::string what, double measured, double reference,
                                               double tolerance);
/// |measured - reference|.
[[nodiscard]] VerificationCheck check_absolute(std::string what, double measured, double reference,
                                               double tolerance);

/// A named case.
struct VerificationCase {
  const char* name;
  const char* description;
  std::vector<VerificationCheck> (*run)();
};

/// Kinematics, integration, conservation.
[[nodiscard]] std::span<const VerificationCase> kinematics_cases();
/// One block, by order.
[[nodiscard]] std::span<const VerificationCase> one_block_cases();
/// Contact springs at rest.
[[nodiscard]] std::span<const VerificationCase> contact_spring_cases();
/// Friction on slopes.
[[nodiscard]] std::span<const VerificationCase> slope_cases();
/// Stacks, columns and arches.
[[nodiscard]] std::span<const VerificationCase> stack_cases();
/// Impacts, waves and rocking.
[[nodiscard]] std::span<const VerificationCase> impact_cases();

}  // namespace ashlar

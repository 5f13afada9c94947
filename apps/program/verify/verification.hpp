// Verification cases of `ashlar verify`. Each compares numbers of this program with independent references: formulas,
// or values computed by other means.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/program/verify/placement.hpp"

namespace ashlar {

/// One comparison.
struct VerificationCheck {
  std::string what;
  double measured;
  double reference;
  double error;      ///< compared with the tolerance: relative to the reference, or absolute
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
class VerificationCase {
 public:
  using Run = std::vector<VerificationCheck> (*)();
  using RunPlaced = std::vector<VerificationCheck> (*)(const Placement&);

  /// A case with a fixed placement, because its supports fix single components.
  constexpr VerificationCase(const char* case_name, const char* text, Run function)
      : name(case_name), description(text), run_(function) {}
  /// A case whose scene can be rotated and translated without effect on the results.
  constexpr VerificationCase(const char* case_name, const char* text, RunPlaced function)
      : name(case_name), description(text), run_placed_(function) {}

  const char* name;
  const char* description;

  [[nodiscard]] std::vector<VerificationCheck> run() const { return run_ ? run_() : run_placed_({}); }
  [[nodiscard]] bool can_be_placed() const { return run_placed_ != nullptr; }
  /// For a case with variable placement.
  [[nodiscard]] std::vector<VerificationCheck> run_placed(const Placement& placement) const {
    return run_placed_(placement);
  }

 private:
  Run run_ = nullptr;
  RunPlaced run_placed_ = nullptr;
};

/// Kinematics, integration, conservation.
[[nodiscard]] std::span<const VerificationCase> kinematics_cases();
/// Contact springs at rest.
[[nodiscard]] std::span<const VerificationCase> contact_spring_cases();
/// Nonconvex solids.
[[nodiscard]] std::span<const VerificationCase> non_convex_cases();
/// Hertz's contact.
[[nodiscard]] std::span<const VerificationCase> hertz_cases();
/// Tunnels and wedges in their roofs.
[[nodiscard]] std::span<const VerificationCase> tunnel_cases();
/// Records of earthquakes.
[[nodiscard]] std::span<const VerificationCase> record_cases();
/// Rock cut by joints.
[[nodiscard]] std::span<const VerificationCase> cutting_cases();
/// Cases that other programs have published.
[[nodiscard]] std::span<const VerificationCase> peer_cases();
/// The paper's example.
[[nodiscard]] std::span<const VerificationCase> falling_block_cases();

/// All cases, in the order of the list.
[[nodiscard]] std::vector<VerificationCase> all_verification_cases();

}  // namespace ashlar

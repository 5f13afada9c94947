// Runs that are asked for an accuracy.
#include <fmt/format.h>

#include <array>

#include "apps/program/study/error_time_study.hpp"
#include "apps/program/verify/verify_effectivity.hpp"

namespace ashlar {
namespace {

std::vector<VerificationCheck> check_accuracy() {
  std::vector<VerificationCheck> checks;
  // A run that cannot reach its accuracy says so: its error is at most twice what it tells.
  for (const ChosenRun& run : chosen_runs(3))
    checks.push_back(check_absolute(fmt::format("{}, error with an accuracy of {:.0e} (told {:.1e})",
                                                run.name, run.accuracy, run.estimate),
                                    run.error, 0.0,
                                    run.estimate <= run.accuracy ? run.accuracy : 2.0 * run.estimate));
  return checks;
}

constexpr std::array<VerificationCase, 2> accuracy_case_list = {
    {{"accuracy-asked", "orders and steps chosen for an accuracy: true errors", check_accuracy},
     {"effectivity", "estimated errors of orders and steps over true ones", check_effectivity}}};

}  // namespace

std::span<const VerificationCase> accuracy_cases() {
  return accuracy_case_list;
}

}  // namespace ashlar

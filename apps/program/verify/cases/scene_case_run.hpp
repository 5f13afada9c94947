// Runs of verification cases that are scenes, as `ashlar run` runs them.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/program/verify/cases/scene_case.hpp"
#include "apps/program/verify/verification.hpp"

namespace ashlar {

/// Runs all variants of a case. A run that fails or is not completed is a failed check.
/// @param kept if not empty: each variant leaves its result folder, its scene and the command that repeats it there
/// @param diagnostics faults: a scene with errors, a check that cannot be evaluated, an expectation that is no number
[[nodiscard]] std::vector<VerificationCheck> run_case(const SceneCase& chosen,
                                                      const std::filesystem::path& kept,
                                                      Diagnostics& diagnostics);

}  // namespace ashlar

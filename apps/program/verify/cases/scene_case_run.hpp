// Runs of verification cases that are scenes, as `ashlar run` runs them.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/program/verify/cases/scene_case.hpp"
#include "apps/program/verify/verification.hpp"

namespace ashlar {

/// Runs all variants of a case. A run that fails or is not completed is a failed check.
///
/// With a placement the scene is rotated and shifted as a whole before it is cut and built (scene_placement.hpp). Rows
/// are turned back to the scene's own axes before checks are evaluated, so that those of the case hold as they are
/// (placed_rows.hpp), if they use
/// - differences of energy.gravity, which changes by a constant: its zero is the origin;
/// - no vectors and places of summary.json, which are those of the placed scene.
/// @param kept if not empty: each variant leaves its result folder, its scene and the command that repeats it there; a
/// placed one has the results of the placed scene, without a command
/// @param diagnostics faults: a scene with errors, a check that cannot be evaluated, an expectation that is no number
/// @throws std::invalid_argument if the scene cannot be placed
[[nodiscard]] std::vector<VerificationCheck> run_case(const SceneCase& chosen,
                                                      const std::filesystem::path& kept,
                                                      Diagnostics& diagnostics,
                                                      const Placement& placement = {});

}  // namespace ashlar

// Files of a pushover beside the summary: its curve as a table and a drawing, and the kinematic check as a table.
#pragma once

#include <filesystem>
#include <string>

#include "apps/run/answers/answer.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// displacement (m), multiplier, spectral_displacement (m), spectral_acceleration (m/s^2; both nan without forces in
/// proportion to mass), moving (number of blocks), blocks (their names, separated by blanks): along the weakest direction.
[[nodiscard]] std::string pushover_table(const PushoverFindings& findings, const Simulation& simulation);

/// The curve of the weakest direction as SVG, with the curves of the others in grey.
[[nodiscard]] std::string pushover_picture(const PushoverFindings& findings);

/// Writes pushover.csv, pushover.svg and, with a kinematic check, kinematic.csv. Does nothing without a curve.
/// @throws std::runtime_error with path and reason
void write_pushover(const PushoverFindings& findings, const Simulation& simulation,
                    const std::filesystem::path& folder);

}  // namespace ashlar

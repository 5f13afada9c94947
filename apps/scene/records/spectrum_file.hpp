// Response spectra from tables: periods and pseudo-accelerations in a line each, as `ashlar spectrum` writes them.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene_pushover.hpp"

namespace ashlar {

/// The first column has the periods (s). Values are in the column "pseudo_acceleration" if there is one, else in the second
/// one. Periods increase and values are not negative. Faults are reported at their line and column of the file; a file that
/// cannot be read at `place`.
/// @param scale of the values, to m/s^2. @param folder of relative paths. @return empty if there is a fault
[[nodiscard]] std::optional<std::vector<SceneSpectrum::Point>> read_spectrum(
    const std::filesystem::path& file, double scale, const std::filesystem::path& folder, const Place& place,
    Diagnostics& diagnostics);

}  // namespace ashlar

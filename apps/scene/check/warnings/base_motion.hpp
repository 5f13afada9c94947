// Moving supports: implausible records, and the block that is the base.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/expanded_scene.hpp"

namespace ashlar {

/// Acceleration in a step relative to that of a smooth curve through the rows, up to which no warning is given.
inline constexpr double largest_ordinary_jump = 10.0;

/// Warns of each displacement_history with linear interpolation between rows that are farther apart than time_step,
/// if the acceleration in a step at a row, (jump of velocity) / time_step, exceeds largest_ordinary_jump times the
/// largest one of the natural cubic spline through the rows: it grows without bound as steps get shorter. A motion
/// that begins or ends with a velocity jumps there. Not in statics.
void warn_of_jumping_supports(const ExpandedScene& scene, Diagnostics& diagnostics);

/// Velocities and accelerations at the end of velocity and acceleration records (or of the analysis, if it comes
/// first), one line each.
[[nodiscard]] std::vector<std::string> motion_left(const Scene& scene);

/// Index into scene.block of the base moved by histories of supports: the only block with such a history, or the
/// first of several with the same histories. Empty if a block or support is held at rest elsewhere (a history then is
/// that of a jack), or the histories of two blocks differ.
[[nodiscard]] std::optional<std::size_t> moved_base(const Scene& scene);

}  // namespace ashlar

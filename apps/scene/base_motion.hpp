// Supports that move: records that do not mean what they seem to, and the block that is the base.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"

namespace ashlar {

/// A step sees no more than this many times the acceleration of a smooth curve through the rows.
inline constexpr double largest_ordinary_jump = 10.0;

/// Warns of each displacement_history with straight lines between rows that are farther apart than time_step,
/// where the acceleration that a step sees at a row, (jump of velocity) / time_step, exceeds
/// largest_ordinary_jump times the largest one of the natural cubic spline through the rows: it grows without
/// bound as steps get shorter. A motion that begins or ends at speed jumps there. Not in statics.
void warn_of_jumping_supports(const Scene& scene, Diagnostics& diagnostics);

/// What velocity and acceleration records leave at their end (that of the analysis, if it comes first), one
/// line each.
[[nodiscard]] std::vector<std::string> motion_left(const Scene& scene);

/// Index into scene.block of the base that histories of supports move: the only block with such a history, or the first
/// of several with the same histories. None if a block or support is held at rest elsewhere (a history then is that of
/// a jack), or the histories of two blocks differ.
[[nodiscard]] std::optional<std::size_t> moved_base(const Scene& scene);

}  // namespace ashlar

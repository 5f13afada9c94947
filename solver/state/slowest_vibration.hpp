// The slowest vibration of a block by itself: whether a time step resolves how it deforms in an impact.
#pragma once

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Largest product of angular frequency and time step of a vibration that steps resolve: a quarter of a period has some
/// ten steps.
inline constexpr double resolved_angle = 0.15;

/// Angular frequency of the slowest vibration of an undeformed block in its supports, 1/s; infinity for rigid and fixed
/// blocks, and if supports hold all its motions.
[[nodiscard]] double slowest_vibration(const BlockModel& block);

}  // namespace ashlar

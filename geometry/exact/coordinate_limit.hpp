// The largest coordinate that is read from a file; notes/largest_coordinate.md says why there is one.
#pragma once

#include <cmath>

namespace ashlar {

/// m. Squared distances between points up to here are at most 1.2e301, with room to the largest
/// double, 1.8e308.
inline constexpr double largest_coordinate = 1e150;

/// Whether a coordinate is finite and beyond the limit. What is not finite has messages of its own.
[[nodiscard]] inline bool is_too_far(double coordinate) {
  return std::isfinite(coordinate) && std::abs(coordinate) > largest_coordinate;
}

}  // namespace ashlar

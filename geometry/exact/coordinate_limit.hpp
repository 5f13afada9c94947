// The largest coordinate read from a file; for the reason see notes/largest_coordinate.md.
#pragma once

#include <cmath>

namespace ashlar {

/// m. Squared distances between points up to here are at most 1.2e301, with room to the largest
/// double, 1.8e308.
inline constexpr double largest_coordinate = 1e150;

/// True if a coordinate is finite and beyond the limit. Values that are not finite have messages of their own.
[[nodiscard]] inline bool is_too_far(double coordinate) {
  return std::isfinite(coordinate) && std::abs(coordinate) > largest_coordinate;
}

}  // namespace ashlar

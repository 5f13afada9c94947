// Allowed ranges of the numbers of a scene, with their descriptions for users.
#pragma once

#include <limits>

#include "geometry/exact/coordinate_limit.hpp"

namespace ashlar {

/// A range of numbers and its description ("a number > 0").
struct NumberRange {
  double low;
  double high;
  bool low_allowed;
  bool high_allowed;
  const char* words;

  [[nodiscard]] bool contains(double value) const {
    return (low_allowed ? value >= low : value > low) && (high_allowed ? value <= high : value < high);
  }
};

namespace range {

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

inline constexpr NumberRange any_number = {-no_limit, no_limit, false, false, "a number"};
inline constexpr NumberRange positive = {0.0, no_limit, false, false, "a number > 0"};
inline constexpr NumberRange positive_length = {0.0, largest_coordinate, false, true,
                                                "a number > 0 and <= 1e150"};
inline constexpr NumberRange at_least_one = {1.0, no_limit, true, false, "a number >= 1"};
inline constexpr NumberRange not_negative = {0.0, no_limit, true, false, "a number >= 0"};
inline constexpr NumberRange positive_to_one = {0.0, 1.0, false, true, "a number > 0 and <= 1"};
inline constexpr NumberRange zero_to_one = {0.0, 1.0, true, true, "a number from 0 to 1"};
inline constexpr NumberRange zero_to_below_half = {0.0, 0.5, true, false, "a number >= 0 and < 0.5"};
inline constexpr NumberRange above_zero_to_20 = {0.0, 20.0, false, true, "a number > 0 and <= 20"};
inline constexpr NumberRange zero_to_45 = {0.0, 45.0, true, true, "a number of degrees from 0 to 45"};
inline constexpr NumberRange zero_to_90 = {0.0, 90.0, true, true, "a number of degrees from 0 to 90"};
inline constexpr NumberRange zero_to_below_90 = {0.0, 90.0, true, false, "a number of degrees >= 0 and < 90"};

}  // namespace range
}  // namespace ashlar

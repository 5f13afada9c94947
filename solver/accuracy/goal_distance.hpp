// Lengths of the values of a goal.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace ashlar {

/// |a - b|. @param a,b as many
[[nodiscard]] inline double goal_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

[[nodiscard]] inline double goal_length(const std::vector<double>& values) {
  return goal_distance(values, std::vector<double>(values.size(), 0.0));
}

}  // namespace ashlar

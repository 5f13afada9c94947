#include "apps/results/frames/stored_real.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ashlar {

float to_float32(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::isfinite(value) ? std::clamp(value, -largest, largest) : value);
}

std::vector<float> to_float32(std::span<const double> values) {
  std::vector<float> rounded;
  rounded.reserve(values.size());
  for (const double value : values) rounded.push_back(to_float32(value));
  return rounded;
}

}  // namespace ashlar

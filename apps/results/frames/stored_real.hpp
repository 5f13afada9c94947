// Real numbers in files of frames: double, or single precision in half the space.
#pragma once

#include <span>
#include <vector>

namespace ashlar {

/// How a file stores numbers that are double in memory.
enum class StoredReal {
  float64,
  float32,
};

/// The nearest number of single precision; beyond its range its largest one (3.4e38). Infinities and NaN stay.
[[nodiscard]] float to_float32(double value);
[[nodiscard]] std::vector<float> to_float32(std::span<const double> values);

}  // namespace ashlar

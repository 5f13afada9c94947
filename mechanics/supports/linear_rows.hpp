// Values over time: linear between rows, constant before the first and after the last.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ashlar {

/// @param times s, increasing, at least one. @param values of each row, same number
template <class Value>
[[nodiscard]] Value linear_between_rows(const std::vector<double>& times, const std::vector<Value>& values,
                                        double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return values.front();
  if (after == times.end()) return values.back();
  const auto k = static_cast<std::size_t>(after - times.begin());
  const double share = (time - times[k - 1]) / (times[k] - times[k - 1]);
  return values[k - 1] + share * (values[k] - values[k - 1]);
}

/// True if values may differ between two times. @param times of the rows; none: never
[[nodiscard]] inline bool rows_change_between(const std::vector<double>& times, double start, double end) {
  return !times.empty() && times.front() < end && times.back() > start;
}

}  // namespace ashlar

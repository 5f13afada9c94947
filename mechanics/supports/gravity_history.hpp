// Gravity that changes over time: a tilted table, an earthquake as a force (pseudo-static analysis).
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Gravity over time: linear between the rows, constant before the first and after the last.
struct GravityHistory {
  std::vector<double> times;    ///< s, increasing
  std::vector<Vector3> values;  ///< same number, m/s^2

  [[nodiscard]] bool empty() const { return times.empty(); }
  /// @return m/s^2. @pre the history is not empty
  [[nodiscard]] Vector3 at(double time) const;
  /// True if gravity may differ between two times.
  [[nodiscard]] bool changes_between(double start, double end) const;
  /// Largest absolute value at any time, m/s^2; 0 if empty.
  [[nodiscard]] double largest() const;
};

}  // namespace ashlar

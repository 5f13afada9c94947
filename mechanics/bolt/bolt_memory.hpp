// Memory of a bolt from step to step.
#pragma once

#include <vector>

namespace ashlar {

/// Empty vectors: not installed.
struct BoltMemory {
  double installed = 0.0;  ///< m, elongation at installation of a bar anchored at its ends
  std::vector<double>
      places;                 ///< by station: place of the bar along itself, m; empty if anchored at its ends
  std::vector<double> bar;    ///< by spring of the bar: plastic elongation, m; pretension is a negative one
  std::vector<int> ruptured;  ///< by spring of the bar: 1 if it is
  std::vector<double> bond;   ///< by station: plastic slip, m
  std::vector<double> dowels;  ///< by dowelled crossing: plastic shear along n_1 and n_2, m
  std::vector<int> sheared;    ///< by station and then dowel: 1 if it has yielded

  [[nodiscard]] bool is_installed() const { return !bar.empty(); }
};

}  // namespace ashlar

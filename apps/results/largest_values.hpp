// Where a state is most displaced, compressed and stretched: what an engineer asks first.
#pragma once

#include <optional>
#include <vector>

#include "apps/results/drawn_surface.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// A value and where it is.
struct PlacedValue {
  double value;  ///< m or Pa, > 0
  int block;
  Vector3 place;  ///< current coordinates, m
};

/// Of all blocks that are there and not fixed, at the points where they are drawn: corners, and of blocks that may
/// bend points between them too. None: nothing is displaced, compressed or stretched.
struct LargestValues {
  std::optional<PlacedValue> displacement;  ///< m
  std::optional<PlacedValue> compression;   ///< Pa, minus the least principal stress
  std::optional<PlacedValue> tension;       ///< Pa, the largest principal stress
};

/// @param surfaces of each block. @param origin displacements that count as none, by block and point; empty: none
[[nodiscard]] LargestValues largest_values(const Simulation& simulation,
                                           const std::vector<DrawnSurface>& surfaces,
                                           const std::vector<std::vector<Vector3>>& origin = {});

}  // namespace ashlar

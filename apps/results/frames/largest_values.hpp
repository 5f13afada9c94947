// Places of the largest displacement, compression, tension and strain of a state.
#pragma once

#include <optional>
#include <vector>

#include "apps/results/frames/drawn_surface.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// A value and its place.
struct PlacedValue {
  double value;  ///< m, Pa or 1, > 0
  int block;
  Vector3 place;  ///< current coordinates, m
};

/// Extremes over all present blocks that are not fixed, at the points where they are drawn: corners, and for blocks
/// that may bend points between them too. Empty: no displacement, compression, tension or strain.
struct LargestValues {
  std::optional<PlacedValue> displacement;  ///< m
  std::optional<PlacedValue> compression;   ///< Pa, minus the least principal stress
  std::optional<PlacedValue> tension;       ///< Pa, the largest principal stress
  /// Largest magnitude of a principal strain of the stress by Hooke's law, whatever caused it: initial stress counts, too.
  /// Of St.-Venant-Kirchhoff blocks it differs from the Green strain by the square of the strain
  std::optional<PlacedValue> strain;
};

/// @param surfaces of each block. @param origin displacements to be subtracted, by block and point; empty: none
[[nodiscard]] LargestValues largest_values(const Simulation& simulation,
                                           const std::vector<DrawnSurface>& surfaces,
                                           const std::vector<std::vector<Vector3>>& origin = {});

}  // namespace ashlar

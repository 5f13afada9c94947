// Rows of history.csv of a placed scene, in the scene's own axes.
#pragma once

#include <vector>

#include "apps/program/verify/placement.hpp"
#include "apps/results/columns/column.hpp"

namespace ashlar {

/// Rotates vectors and tensors back, and shifts places: `x`, `y` and `z` of measures. The angular momentum L' of a
/// placed scene about its origin is that of the scene about its own one, L, with
///   L' = R L + c x p',
/// R the rotation, p' the momentum and c the place of the scene's own origin relative to the placed one's.
///
/// Numbers stay: energy.gravity, -m g . x from the origin, differs by a constant, and `runout` has another meaning if
/// gravity is zero or has a history, since it is then measured across z.
/// @param columns of the rows (#columns). @param rows (#rows x #columns)
/// @param center c, m, in the axes of the placed scene
[[nodiscard]] std::vector<std::vector<double>> turned_back(const std::vector<Column>& columns,
                                                           std::vector<std::vector<double>> rows,
                                                           const Placement& placement, const Vector3& center);

}  // namespace ashlar

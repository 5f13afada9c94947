// Measures as goals of an accuracy.
#pragma once

#include <vector>

#include "apps/results/tables/measure.hpp"
#include "solver/accuracy/static_accuracy.hpp"

namespace ashlar {

/// A goal for each measure with a value: the displacement of a point or block, with its velocity, and the drift, m; the normal and shear
/// force of a pair, or the axial and shear force of a bolt, N; the largest opening and slip of cracks, m. Lengths count
/// from 1e-6 of the largest displacement of a block on, forces from 1e-6 of the sum of contact forces: below, they are
/// as good as zero.
/// @param measures of the same simulation. Those of absent blocks have the value zero
[[nodiscard]] std::vector<Goal> goals_of(const Simulation& simulation, const std::vector<Measure>& measures);

}  // namespace ashlar

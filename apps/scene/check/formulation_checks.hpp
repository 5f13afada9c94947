// Checks of the incremental formulation, the paper's.
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Reports keys and tables that incremental blocks do not have: static analysis, accuracy, order 0, elasticity beyond the
/// linear one, bolts, water, initial stress, boundaries, restitution, an accepted overlap, sub-faces by a tolerance, output
/// of curved faces and of volumes, and measures other than those of points and pairs. Ties are refused where they are made
/// (build_simulation.hpp). Reports nothing of the total formulation.
/// @param scene of one stage
void check_formulation(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

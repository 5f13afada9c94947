// The ground of a scene as the solver has it: blocks as placed, and [[boundary]] (solver/ground/).
#pragma once

#include <string>
#include <vector>

#include "apps/scene/model/scene.hpp"
#include "solver/ground/ground_boundary.hpp"
#include "solver/ground/side_layers.hpp"

namespace ashlar {

/// @param solids by block, which the result refers to; null: not built
[[nodiscard]] std::vector<GroundBlock> ground_blocks_of(const Scene& scene,
                                                        const std::vector<const Polyhedron*>& solids);
[[nodiscard]] std::vector<GroundBlock> ground_blocks_of(const Scene& scene,
                                                        const std::vector<Polyhedron>& solids);

/// By [[boundary]], with the same numbers.
[[nodiscard]] std::vector<GroundBoundary> ground_boundaries_of(const Scene& scene);

/// Reason why a free-field boundary has no column, in words.
[[nodiscard]] std::string words_of(const SideLayersFault& fault);

}  // namespace ashlar

// contact.fit: blocks of surveyed coordinates put onto common planes before anything is asked of them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Does what fitted_solids.hpp says where the scene has a fit, and notes what was done. Reported at the key:
/// a fit that is too large for the blocks.
/// @param solids,shapes as build_solids gives them; a block that was changed has its placed solid as shape
void fit_to_survey(Scene& scene, std::vector<std::optional<Polyhedron>>& solids,
                   std::vector<std::shared_ptr<const Polyhedron>>& shapes, Diagnostics& diagnostics);

}  // namespace ashlar

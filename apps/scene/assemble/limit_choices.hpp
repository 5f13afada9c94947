// Loads of a scene that are changed by a search for a factor.
#pragma once

#include <vector>

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// By block, true if its loads are multiplied by a search for a capacity (analysis.capacity.blocks).
[[nodiscard]] std::vector<bool> multiplied_blocks(const Scene& scene);

/// By block, true if its loads are multiplied by a pushover (analysis.pushover.blocks).
[[nodiscard]] std::vector<bool> pushed_by_loads(const Scene& scene);

}  // namespace ashlar

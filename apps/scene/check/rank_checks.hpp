// Scenes that several ranks cannot share yet.
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Reports each setting that is possible on one rank only (solver/notes/ranks.md).
void check_for_ranks(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

// Checks of compressive_strength in [contact], [[joint]] and [[stage.joint]].
#pragma once

#include <optional>
#include <string>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Path of the first compressive_strength, as in ScenePlaces; empty: none is given.
[[nodiscard]] std::optional<std::string> first_compressive_strength(const Scene& scene);

/// Reports compressive strengths below tensile ones, and analyses without joints that crush.
void check_compressive_strengths(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

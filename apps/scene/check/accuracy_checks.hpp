// Checks of analysis.accuracy and of values that it chooses.
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Reports an accuracy of a search or of stages, which have none; an automatic step beside ground
/// that is computed beforehand; and "auto" without an accuracy.
void check_accuracy(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

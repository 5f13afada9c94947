// A scene as the Python module holds it.
#pragma once

#include <memory>
#include <vector>

#include "apps/scene/scene_loading.hpp"

namespace ashlar {

/// A scene and what was found at fault in it.
struct CoreScene {
  std::shared_ptr<const LoadedScene> loaded;  ///< null: there are errors
  std::vector<Diagnostic> faults;             ///< errors and warnings
};

}  // namespace ashlar

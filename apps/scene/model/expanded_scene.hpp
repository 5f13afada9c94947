// A scene after its expansion, as a type: passes that need single bodies take it, and a scene as written cannot be given
// to them. Scene (as written) -> ExpandedScene -> LoadedScene (with solids; build/scene_loading.hpp).
#pragma once

#include <utility>

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Each block is one body: blocks of masonry, arrays and meshes, and pieces of cuts, are in `block` in place of what they
/// are made from; blocks chosen by place and the assignments by name have been applied.
struct ExpandedScene : Scene {
  /// @param scene that has passed through expand/ (load_scene does)
  explicit ExpandedScene(Scene scene) : Scene(std::move(scene)) {}
};

}  // namespace ashlar

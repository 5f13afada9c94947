// inside = { box | mesh | hull | sphere | halfspace }: blocks of a scene (scene.hpp) chosen by their place.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "apps/scene/model/scene_shape.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// All places x with normal . (x - point) <= 0: the normal is outward, as that of a face.
struct SceneHalfspace {
  Vector3 point = Vector3::Zero();   ///< m
  Vector3 normal = Vector3::Zero();  ///< not zero, any length
};

/// A closed part of space. A block is inside if its centroid is, as the block is placed at the start.
struct SceneRegion {
  std::variant<SceneHalfspace, SceneShape> space;  ///< a shape without a kind was not read
  /// Indices of the blocks inside, increasing; empty until choose_blocks_inside (region_blocks.hpp)
  std::vector<std::size_t> blocks = {};
};

}  // namespace ashlar

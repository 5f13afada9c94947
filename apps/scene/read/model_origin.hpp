// The origin of the model of a scene, found before its tables are read (model_position.hpp).
#pragma once

#include <string>
#include <vector>

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_reading.hpp"
#include "geometry/boxes/box.hpp"

namespace ashlar {

/// Scene::origin for the blocks and masonry of a document, m. Faults are ignored, they are reported when the tables are
/// read. Files of meshes are read.
/// @param files see TomlReading
[[nodiscard]] Vector3 origin_of_model(const toml::table& document, const std::vector<std::string>& files);

/// A box around the blocks of a scene that has been read, relative to its origin, m. Files of meshes are read.
[[nodiscard]] Box box_of_blocks(const Scene& scene);

/// SceneBlock::shape_origin of a block as read, m: the origin of the model, unless `translate` takes the shape there from
/// elsewhere.
[[nodiscard]] Vector3 shape_origin_of(const SceneBlock& block, const TomlReading& reading);

}  // namespace ashlar

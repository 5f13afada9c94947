// [[water]]: water in joints and on free faces (scene.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene_block.hpp"
#include "apps/scene/model/scene_record.hpp"

namespace ashlar {

/// Hydrostatic pressure below a level, or below a piezometric surface. The last entry that matches a joint, or the free
/// faces of a block, counts there.
struct SceneWater {
  std::string name = "water";               ///< unique; an entry of a stage replaces the one of its name
  ScenePlane level;                         ///< the level if there is no file; its normal is not horizontal
  std::optional<SceneRecord> file;          ///< columns x, y, z of points of the level
  std::vector<Vector3> surface;             ///< m, points of the file
  double unit_weight = 0.0;                 ///< N/m^3, > 0; required
  std::vector<std::string> joints = {"*"};  ///< names or globs of cuts, and of blocks on either side
  std::vector<std::string> faces = {"*"};   ///< names or globs of blocks whose free faces are pressed
};

}  // namespace ashlar

// [[load]]: a force that moves over the blocks of a scene (scene.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene_record.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

struct SceneMovingLoad {
  struct Stop {
    double time = 0.0;                ///< s
    Vector3 place = Vector3::Zero();  ///< m
  };

  std::vector<std::string> blocks = {"*"};  ///< names or globs of the blocks that it may stand on
  Vector3 force = Vector3::Zero();          ///< N, not zero; required
  std::vector<Stop> path;                   ///< times increase, linear between; required
  std::optional<SceneRecord> file;          ///< its file, if not in the scene
  std::optional<double> spacing;  ///< m, > 0, largest distance of points of the path where it is applied;
                                  ///< empty: 1/100 of the path
};

}  // namespace ashlar

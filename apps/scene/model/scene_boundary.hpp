// [[boundary]]: planes in which the model ends but the ground does not (scene.hpp).
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/scene_block.hpp"
#include "apps/scene/model/scene_record.hpp"

namespace ashlar {

/// Dashpots on all faces in a plane whose outward normals are its normal, of all moving blocks (quiet_faces.hpp).
struct SceneBoundary {
  enum class Kind {
    quiet,       ///< dashpots of the material of each block
    free_field,  ///< beside it a column of the ground, moved by the wave of the quiet boundary below
  };
  ScenePlane plane;  ///< its normal points out of the model
  Kind kind = Kind::quiet;
  /// m/s, velocity of a wave that comes from outside; times increase; empty: none. With stages it acts in the first
  /// dynamic one. `value` of each row
  std::vector<SceneFix::Motion> wave;
  std::optional<SceneRecord> file;   ///< its file, if not in the scene
  std::optional<Vector3> direction;  ///< of a file with one column, not zero; `wave` has this direction
};

}  // namespace ashlar

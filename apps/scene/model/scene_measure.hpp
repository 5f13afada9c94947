// [[measure]]: quantities with columns in the history (scene.hpp).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene_region.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// drift = { blocks, inside, heights }: two levels of a set of blocks.
struct SceneDrift {
  std::vector<std::string> blocks;    ///< names or globs
  std::optional<SceneRegion> inside;  ///< only those of `blocks` inside
  std::array<double, 2> heights = {0.0,
                                   0.0};  ///< m, lower and upper level, along the direction against gravity
};

/// crack = { joints, to }: joints as they were at the start.
struct SceneCrack {
  std::vector<std::string> joints = {"*"};  ///< names or globs of cuts, and of blocks on either side
  std::vector<std::string> to;              ///< if not empty: names or globs of the blocks on the other side
};

/// A material point, a block, a pair of blocks, a bolt, a drift or the width of cracks: exactly one.
struct SceneMeasure {
  std::string name;                   ///< unique; required; heads columns of the history
  std::string block;                  ///< name of a [[block]]; empty: `pair` or one of the others is measured
  std::optional<SceneRegion> inside;  ///< in place of the name, which is that of the one block inside
  std::optional<Vector3> point;       ///< m, in the placed, undeformed block; empty: the block as a whole
  std::array<std::string, 2> pair;    ///< names of two blocks whose contacts are measured; otherwise empty
  std::string bolt;                   ///< name of a bolt or prop that is measured; otherwise empty
  std::optional<SceneDrift> drift;
  std::optional<SceneCrack> crack;
};

}  // namespace ashlar

// Removable blocks of a scene, by block theory (geometry/cutting/key_block.hpp).
#pragma once

#include <optional>
#include <vector>

#include "apps/program/blocks/block_report.hpp"
#include "apps/scene/model/scene_block.hpp"

namespace ashlar {

struct RemovableBlock {
  std::size_t block;
  KeyBlock key;
  /// Frictional part of the normal forces over the driving force of the block along its direction; 0: free fall,
  /// infinite: no driving force.
  double factor_of_safety;
  double weight = 0.0;  ///< N, density times volume times the gravity of the scene
  /// N, against the direction of its motion, for the factor that is wanted; 0: none
  double needed = 0.0;
};

struct RemovableSearch {
  Vector3 force;                    ///< on every block, of any length but zero
  double wanted = 1.0;              ///< > 0, factor for which the needed force is told
  std::vector<ScenePlane> borders;  ///< of the model, besides the planes of supports and boundaries
};

/// Examines each moving block without a tie that has a free face: one not completely covered, and not in a border of the
/// model, which are the planes of [[block.fix]], of [[boundary]] and those given. It is restrained by the planes of its
/// borders with others, and by its supports in the components that they fix. Cohesion is ignored. If several neighbours are at
/// a plane, the tangents of their friction angles are weighted by area.
[[nodiscard]] std::vector<RemovableBlock> find_removable_blocks(const BlockReport& report,
                                                                const RemovableSearch& search);

}  // namespace ashlar

// Removable blocks of a scene, by block theory (geometry/cutting/key_block.hpp).
#pragma once

#include <optional>
#include <vector>

#include "apps/program/blocks/block_report.hpp"

namespace ashlar {

struct RemovableBlock {
  std::size_t block;
  KeyBlock key;
  /// Frictional part of the normal forces over the driving force of the block along its direction; 0: free fall,
  /// infinite: no driving force.
  double factor_of_safety;
};

/// Examines each moving block without support or tie that has a face not completely covered. It is restrained by the
/// planes of its borders. Cohesion is ignored. If several neighbours are at a plane, the tangents of their friction
/// angles are weighted by area.
/// @param force on every block, of any length but zero
[[nodiscard]] std::vector<RemovableBlock> find_removable_blocks(const BlockReport& report,
                                                                const Vector3& force);

}  // namespace ashlar

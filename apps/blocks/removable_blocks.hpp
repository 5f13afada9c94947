// Which blocks of a scene can leave their places, by block theory (geometry/cutting/key_block.hpp).
#pragma once

#include <optional>
#include <vector>

#include "apps/blocks/block_report.hpp"

namespace ashlar {

struct RemovableBlock {
  std::size_t block;
  KeyBlock key;
  /// Friction's part of the normal forces over what drives the block along its direction; 0: it falls,
  /// infinite: nothing drives it.
  double factor_of_safety;
};

/// For each block that moves, has no support or tie, and has a face that is not wholly covered: what holds it
/// are the planes that it has borders in. Cohesion counts for nothing. Where several neighbours lie at a
/// plane, the tangents of their friction angles count by area.
/// @param force on every block, any length but zero
[[nodiscard]] std::vector<RemovableBlock> find_removable_blocks(const BlockReport& report,
                                                                const Vector3& force);

}  // namespace ashlar

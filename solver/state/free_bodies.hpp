// Sets of blocks that rotate together and are supported by contacts only.
#pragma once

#include <vector>

#include "mechanics/block/block_model.hpp"
#include "solver/block_pair.hpp"

namespace ashlar {

/// Sets of blocks that rotate together and are supported by contacts only: single blocks, and blocks tied to each
/// other. Excludes fixed, supported and incremental blocks and all blocks tied to one.
/// @param ties pairs of tied blocks. @return increasing block indices, sets in the order of their first
[[nodiscard]] std::vector<std::vector<int>> free_bodies(const std::vector<BlockModel>& blocks,
                                                        const std::vector<PairKey>& ties);

/// True if a block may be part of such a set.
[[nodiscard]] bool may_turn_freely(const BlockModel& block);
/// The same sets. @param free by block: may_turn_freely(), for processes that do not have all models
[[nodiscard]] std::vector<std::vector<int>> free_bodies(const std::vector<bool>& free,
                                                        const std::vector<PairKey>& ties);

}  // namespace ashlar

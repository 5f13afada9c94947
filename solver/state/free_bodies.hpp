// Which blocks turn as one, with nothing but contacts to hold them.
#pragma once

#include <array>
#include <vector>

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Sets of blocks that turn as one and that nothing but contacts holds: single blocks, and blocks tied to
/// each other. Fixed, supported and incremental blocks, and all that are tied to one, are in none.
/// @param ties pairs of tied blocks. @return increasing block indices, sets in the order of their first
[[nodiscard]] std::vector<std::vector<int>> free_bodies(const std::vector<BlockModel>& blocks,
                                                        const std::vector<std::array<int, 2>>& ties);

}  // namespace ashlar

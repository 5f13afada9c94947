// The blocks of a scene in words and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/blocks/removable_blocks.hpp"

namespace ashlar {

/// Lines for a user: numbers and volumes, areas by cut, and the blocks that are removable.
[[nodiscard]] std::string report_text(const BlockReport& report,
                                      const std::vector<RemovableBlock>* removable);

/// { count, volume, blocks: [{ name, volume, faces, material, neighbours: [{ block, area, cut }], key }] };
/// cut is null where no cut parted the two, material where a fixed block has none. `key` is there for blocks
/// that were looked at: { finite, removable, mode, direction, factor_of_safety }, the factor null if
/// infinite.
[[nodiscard]] nlohmann::ordered_json report_json(const BlockReport& report,
                                                 const std::vector<RemovableBlock>* removable);

}  // namespace ashlar

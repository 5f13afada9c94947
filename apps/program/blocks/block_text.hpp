// The blocks of a scene as text and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/program/blocks/removable_blocks.hpp"

namespace ashlar {

/// Summary for a user: numbers and volumes, areas by cut, and the removable blocks.
[[nodiscard]] std::string report_text(const BlockReport& report,
                                      const std::vector<RemovableBlock>* removable);

/// { count, volume, blocks: [{ name, names, volume, centroid, box: { min, max }, faces, material, neighbours: [{ block,
/// area, cut }], key }] }, of the blocks that are there in the stage of the scene; `names` are other names of a piece;
/// cut is null if no cut divided the two, material if a fixed block has none. `key` is present for examined blocks: {
/// finite, removable, mode, direction, factor_of_safety, weight, needed_force (N) }, the factor null if infinite.
[[nodiscard]] nlohmann::ordered_json report_json(const BlockReport& report,
                                                 const std::vector<RemovableBlock>* removable);

/// Key blocks as a table, in the order of their factors: those that are removable and that the force moves.
[[nodiscard]] std::string removable_csv(const BlockReport& report,
                                        const std::vector<RemovableBlock>& removable);

}  // namespace ashlar

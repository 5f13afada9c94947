// Mechanisms of a scene by limit analysis, each with its own factor (solver/limit/key_groups.hpp): key blocks and groups of
// them, with all strengths of joints and with the bolts that are there.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/program/blocks/removable_blocks.hpp"
#include "solver/limit/key_groups.hpp"

namespace ashlar {

class Preparation;

/// @param search its force replaces the direction of gravity, and its wanted factor is that of the needed forces
/// @param most groups. @return by increasing factor, up to the largest of the scene's analysis.safety
/// @param progress receives the present analysis
/// @throws std::exception if the scene cannot be built, or has no limit analysis
[[nodiscard]] std::vector<KeyGroup> find_mechanisms(const LoadedScene& loaded, const RemovableSearch& search,
                                                    int most, Preparation& progress);

/// A row a group: blocks, volume, factor, needed force, mode.
[[nodiscard]] std::string mechanisms_text(const BlockReport& report, const std::vector<KeyGroup>& groups);
/// blocks (with blanks between), volume, place of the largest block, factor_lower (empty: none), factor_upper, needed force as
/// a vector (N), mode.
[[nodiscard]] std::string mechanisms_csv(const BlockReport& report, const std::vector<KeyGroup>& groups);
[[nodiscard]] nlohmann::ordered_json mechanisms_json(const BlockReport& report,
                                                     const std::vector<KeyGroup>& groups);

}  // namespace ashlar

// The identity of results as summary.json states it, and what differs from one that was stated.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/results/scene_identity.hpp"

namespace ashlar {

/// As summary.json has it: version, checkpoint_layout, scene (hexadecimal), files.
[[nodiscard]] nlohmann::ordered_json to_json(const SceneIdentity& identity);

/// "mesh stone.off has changed", ... for each file whose bytes are others; empty where `was` tells nothing.
/// @param was an identity as to_json gives it, or what stands in its place
[[nodiscard]] std::vector<std::string> changed_files(const nlohmann::ordered_json& was,
                                                     const SceneIdentity& is);

/// The same and all other reasons: another version of the program, other blocks. Empty: results of the one are those of
/// the other, up to the end time.
[[nodiscard]] std::vector<std::string> identity_differences(const nlohmann::ordered_json& was,
                                                            const SceneIdentity& is);

}  // namespace ashlar

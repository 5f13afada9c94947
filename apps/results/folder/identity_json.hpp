// The identity of results in summary.json, and differences from an earlier one.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/results/folder/scene_identity.hpp"

namespace ashlar {

/// JSON object for summary.json: version, checkpoint_layout, scene (hexadecimal), files.
[[nodiscard]] nlohmann::ordered_json to_json(const SceneIdentity& identity);

/// "mesh stone.off has changed", ... for each file with other bytes; empty if `was` has no information.
/// @param was an identity from to_json, or any JSON in its place
[[nodiscard]] std::vector<std::string> changed_files(const nlohmann::ordered_json& was,
                                                     const SceneIdentity& is);

/// The same with all other differences: another version of the program, other blocks. Empty: both have the same
/// results up to the end time.
[[nodiscard]] std::vector<std::string> identity_differences(const nlohmann::ordered_json& was,
                                                            const SceneIdentity& is);

}  // namespace ashlar

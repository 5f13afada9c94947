// The stored state of a run in a result folder, and reasons why it cannot be continued.
#pragma once

#include <filesystem>
#include <string>

#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/folder/scene_identity.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// The checkpoint of a folder. @param scene the whole one. @param needed see read_checkpoint()
/// @throws CheckpointError; that of another scene tells what has changed
[[nodiscard]] RunCheckpoint stored_checkpoint(const std::filesystem::path& folder, const Scene& scene,
                                              const SceneIdentity& identity,
                                              const NeededPairs& needed = nullptr);

/// "; changed: KEY (was A, is B), mesh FILE has changed, ..." from the summary of the earlier run in a result folder;
/// empty without a summary or differences.
[[nodiscard]] std::string changes_since(const std::filesystem::path& folder, const Scene& scene,
                                        const SceneIdentity& identity);

}  // namespace ashlar

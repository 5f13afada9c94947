// The file `checkpoint` of a result folder: what `ashlar run --resume` goes on from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/results/contact_changes.hpp"
#include "apps/results/result_folder.hpp"
#include "apps/results/run_summary.hpp"
#include "solver/run/checkpoint.hpp"

namespace ashlar {

/// A run between two steps.
struct RunCheckpoint {
  SimulationSnapshot simulation;      ///< of the present stage
  std::vector<FinishedStage> stages;  ///< those before
  ResultFolderState folder;
  RunSeconds seconds;
  ContactChanges changes;  ///< of static iterations of the present stage
};

/// Why a run cannot go on: no checkpoint, a damaged one, or one of another scene. what() reads as a message
/// to the user.
struct CheckpointError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// That of another scene.
struct OtherSceneError : CheckpointError {
  using CheckpointError::CheckpointError;
};

/// Number of the present layout of the file; another one is refused.
[[nodiscard]] std::uint32_t checkpoint_layout();

/// Replaces the file as a whole; it outlives a power failure. @param hash of the scene (scene_identity.hpp).
/// @return its bytes
/// @throws std::runtime_error with path and reason
std::uintmax_t write_checkpoint(const std::filesystem::path& path, std::uint64_t hash,
                                const RunCheckpoint& checkpoint);

/// @param hash of the scene that is to go on. @throws CheckpointError
[[nodiscard]] RunCheckpoint read_checkpoint(const std::filesystem::path& path, std::uint64_t hash);

}  // namespace ashlar

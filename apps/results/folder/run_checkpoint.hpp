// The file `checkpoint` of a result folder, from which `ashlar run --resume` continues.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/results/folder/accuracy_state.hpp"
#include "apps/results/folder/contact_changes.hpp"
#include "apps/results/folder/motion_verdict.hpp"
#include "apps/results/folder/result_folder.hpp"
#include "apps/results/folder/run_outcome.hpp"
#include "solver/fracture/crack.hpp"
#include "solver/run/checkpoint.hpp"
#include "solver/shared/pairs_of_run.hpp"

namespace ashlar {

inline constexpr const char* checkpoint_name = "checkpoint";  ///< in a result folder

/// A run between two steps.
struct RunCheckpoint {
  SimulationSnapshot simulation;      ///< of the present stage
  std::vector<FinishedStage> stages;  ///< earlier stages
  ResultFolderState folder;
  RunSeconds seconds;
  ContactChanges changes;   ///< of static iterations of the present stage
  AccuracyState accuracy;   ///< of a scene with an accuracy
  FallRecord falls = {};    ///< of steps in time
  CrackRecord cracks = {};  ///< of all stages
};

/// Reason why a run cannot be continued: no checkpoint, a damaged one, or one of another scene. what() is a message
/// to the user.
struct CheckpointError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// Checkpoint of another scene.
struct OtherSceneError : CheckpointError {
  using CheckpointError::CheckpointError;
};

/// Number of the present layout of the file; others are refused.
[[nodiscard]] std::uint32_t checkpoint_layout();

/// Replaces the file as a whole; it survives a power failure. @param hash of the scene (scene_identity.hpp).
/// @param pairs that are visited as they are written, in place of those of the checkpoint's simulation; null: none.
/// Collective then (pairs_of_run.hpp), and after a failure the visits are finished
/// @return its bytes
/// @throws std::runtime_error with path and reason
std::uintmax_t write_checkpoint(const std::filesystem::path& path, std::uint64_t hash,
                                const RunCheckpoint& checkpoint, PairsOfRun* pairs = nullptr);

/// Pairs of a checkpoint that a reader needs; empty: all.
using NeededPairs = std::function<bool(const PairKey& blocks)>;

/// @param hash of the scene to be continued. @param needed of other pairs only the initial overlap is kept
/// @throws CheckpointError
[[nodiscard]] RunCheckpoint read_checkpoint(const std::filesystem::path& path, std::uint64_t hash,
                                            const NeededPairs& needed = nullptr);

}  // namespace ashlar

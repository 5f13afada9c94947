// Numbers of all blocks of a scene that a run begins with, in place of their models: automatic values, joint laws, ties
// and the partition need no more.
//
// Processes that share a run survey the blocks together: process r of N makes the models of the blocks r, r + N, ..., one at a
// time, and tells the others their numbers and faults. A process alone surveys all of them, and keeps their models, as it
// needs them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "apps/scene/assemble/run_ranks.hpp"
#include "apps/scene/assemble/scene_models.hpp"
#include "apps/scene/model/preparation.hpp"

namespace ashlar {

/// Blocks of a scene, by number.
struct BlockSurvey {
  std::vector<BlockSummary> blocks;  ///< all, the same on each process
  std::vector<BlockModel> models;    ///< all, of a process alone; of several processes none
  std::size_t different = 0;         ///< number of blocks without equal ones before them
};

/// Surveys all blocks. Collective. @param ranks null: one
/// @param diagnostics receives blocks that cannot be modelled, as errors, otherwise supports that turn a block
/// (turned_supports.hpp): on each process those of all blocks
/// @param preparation receives the present block, if not null
/// @return empty after errors
[[nodiscard]] std::optional<BlockSurvey> survey_blocks(const SceneModels& models, const RunRanks* ranks,
                                                       Diagnostics& diagnostics,
                                                       Preparation* preparation = nullptr);

}  // namespace ashlar

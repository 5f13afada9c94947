// Keys `ranks`, `rank_imbalance` and `repartitions` of summary.json: work and traffic of the processes that shared a run.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "apps/results/folder/run_summary.hpp"
#include "solver/shared/gathered_run.hpp"

namespace ashlar {

/// Largest processor time of a rank for its own part relative to the mean, minus 1: messages, waiting and shared systems
/// are not counted.
[[nodiscard]] double time_imbalance(const std::vector<RankWork>& ranks);

/// Failed joints of all ranks.
[[nodiscard]] BrokenJoints broken_joints(const std::vector<RankWork>& ranks);

/// Adds these keys. @param ranks by rank
void add_ranks(nlohmann::ordered_json& summary, const std::vector<RankWork>& ranks);

}  // namespace ashlar

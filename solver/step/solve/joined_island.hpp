// Solution of the island whose bodies several processes have.
#pragma once

#include "solver/state/block_system.hpp"
#include "solver/step/island/factor_cache.hpp"
#include "solver/step/island/island.hpp"

namespace ashlar {

/// Solves the joined island, or a part of it. Collective; the status is the same on all processes. The first one counts
/// iterations, the others none.
/// @param settings the same on all. @param kept as of StepExchange::joined_system
[[nodiscard]] IslandResult solve_joined_island(const BlockSystem& system, const Island& island,
                                               std::vector<BodyStep>& bodies,
                                               const std::vector<ContactPair>& pairs,
                                               const TimeScheme& scheme, const SimulationSettings& settings,
                                               SharedFactor* kept = nullptr);

/// Gives moving neighbours the changes of their owners. Collective.
void tell_changes(const BlockSystem& system, std::vector<BodyStep>& bodies);

}  // namespace ashlar

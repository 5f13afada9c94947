// Processes that share a simulation of a scene (solver/notes/ranks.md).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "solver/run/simulation.hpp"

namespace ashlar {

struct RunRanks {
  Ranks& ranks;
  /// Rank of each block, the same on all ranks. Collective. @param places of all blocks
  /// @param work of each block in a step, > 0
  std::function<std::vector<int>(Ranks& ranks, const std::vector<PlacedVolume>& places,
                                 const std::vector<double>& work)>
      owners;
  /// Solver of systems that ranks share; empty: make_gathered_solver()
  std::function<std::unique_ptr<RankSolver>(Ranks& ranks)> solver = {};

  [[nodiscard]] bool several() const { return !ranks.alone(); }
  /// The rank that writes results.
  [[nodiscard]] bool first() const { return ranks.own() == 0; }
};

/// What a simulation of a scene is built from.
struct SimulationParts {
  std::vector<BlockModel> blocks;  ///< all
  std::vector<InitialMotion> motions;
  Simulation::LawOfPair law;
  SimulationSettings settings;
  std::vector<TieRequest> ties;
  std::vector<bool> absent;
};

/// A simulation, or the part of this rank in it. Models of blocks that are not near go then, but for those of the first
/// rank, which writes results. Collective.
/// @param ranks null, or only one: it is this one's alone. @param load makes the model of a block that comes near later
[[nodiscard]] Simulation simulation_of(const RunRanks* ranks, SimulationParts parts, const BlockLoader& load);

}  // namespace ashlar

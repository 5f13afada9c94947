// Processes that share a simulation of a scene (solver/notes/ranks.md).
#pragma once

#include <vector>

#include "apps/scene/assemble/block_summary.hpp"
#include "solver/ranks/partition.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

struct RunRanks {
  Ranks& ranks;
  Partition partition = partition_by_place;
  /// Solver of systems that ranks share; empty: make_gathered_solver()
  RankSolverMaker solver = {};

  [[nodiscard]] bool several() const { return !ranks.alone(); }
  /// The rank that writes results.
  [[nodiscard]] bool first() const { return ranks.own() == 0; }
};

/// Arguments of a Simulation.
struct SimulationParts {
  std::vector<BlockSummary> blocks;  ///< all
  std::vector<BlockModel> models;    ///< all, of a rank alone; of several ranks none
  std::vector<InitialMotion> motions;
  Simulation::LawOfPair law;
  SimulationSettings settings;
  std::vector<TieRequest> ties;
  std::vector<bool> absent;
  std::vector<std::vector<int>> bolted = {};  ///< blocks along each bolt, which better have one rank
};

/// A simulation, or the part of this rank in it. Collective.
/// @param ranks null, or only one: it is this one's alone. @param load makes the models of blocks that this one of several
/// ranks needs, now or later: own ones and those near them, on the first rank, which writes results, of all
[[nodiscard]] Simulation simulation_of(const RunRanks* ranks, SimulationParts parts, const BlockLoader& load);

}  // namespace ashlar

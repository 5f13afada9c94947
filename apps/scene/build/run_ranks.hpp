// Processes that share a simulation of a scene (solver/notes/ranks.md).
#pragma once

#include <vector>

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
  std::vector<BlockModel> blocks;  ///< all
  std::vector<InitialMotion> motions;
  Simulation::LawOfPair law;
  SimulationSettings settings;
  std::vector<TieRequest> ties;
  std::vector<bool> absent;
  std::vector<std::vector<int>> bolted = {};  ///< blocks along each bolt, which better have one rank
};

/// A simulation, or the part of this rank in it. Models of blocks that are not near go then, but for those of the first
/// rank, which writes results. Collective.
/// @param ranks null, or only one: it is this one's alone. @param load makes the model of a block that comes near later
[[nodiscard]] Simulation simulation_of(const RunRanks* ranks, SimulationParts parts, const BlockLoader& load);

}  // namespace ashlar

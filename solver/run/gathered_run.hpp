// Results of a run that several ranks share, put together. All functions are collective; with one rank they are those
// of the simulation.
#pragma once

#include <vector>

#include "solver/run/run_totals.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Sums and extremes over all ranks, the same on each.
[[nodiscard]] RunTotals totals_of_run(const Simulation& simulation);

/// State of each block of the run, by block, on rank 0; on other ranks none.
[[nodiscard]] std::vector<BlockState> states_of_run(const Simulation& simulation);

/// Records of all pairs in contact, by blocks, on rank 0; on other ranks none.
[[nodiscard]] std::vector<PairRecord> contacts_of_run(const Simulation& simulation);

/// Area of strength of a pair so far (PairHistory), m^2.
struct PairBonds {
  PairKey blocks;
  double bonded;
  double broken;
};
/// Of all pairs that have had any, on rank 0; on other ranks none.
[[nodiscard]] std::vector<PairBonds> bonds_of_run(const Simulation& simulation);

/// Work and memory of one rank.
struct RankWork {
  int own = 0;               ///< blocks
  int ghosts = 0;            ///< blocks
  int pairs = 0;             ///< in contact, that this rank makes
  int broken_pairs = 0;      ///< of all those that it has made: with failed area
  double broken_area = 0.0;  ///< m^2
  double bonded_area = 0.0;  ///< m^2, of all joints with strength
  PhaseSeconds seconds;
  RankTraffic traffic;
};
/// By rank; the same on each.
[[nodiscard]] std::vector<RankWork> work_of_ranks(const Simulation& simulation);

}  // namespace ashlar

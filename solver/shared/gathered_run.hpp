// Results of a run that several ranks share, put together. All functions are collective; with one rank they are those
// of the simulation.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "solver/ranks/measured_solver.hpp"
#include "solver/run/simulation.hpp"
#include "solver/shared/run_totals.hpp"

namespace ashlar {

/// Sums and extremes over all ranks, the same on each.
/// @param shown of the pairs that this rank owns
[[nodiscard]] RunTotals totals_of_run(const Simulation& simulation, const ShownContacts& shown = {});

/// State of each block of the run, by block, on rank 0; on other ranks none.
/// @param needs all, or blocks: those of others are as this rank knows them
[[nodiscard]] std::vector<BlockState> states_of_run(const Simulation& simulation,
                                                    const ResultNeeds& needs = {});

/// Records of all pairs in contact, or of the pairs asked for, by blocks, on rank 0; on other ranks none.
[[nodiscard]] std::vector<PairRecord> contacts_of_run(const Simulation& simulation,
                                                      const ResultNeeds& needs = {});

/// Area of strength of a pair so far (PairHistory), m^2.
struct PairBonds {
  PairKey blocks;
  double bonded;
  double broken;
};
/// Of all pairs that have had any, on rank 0; on other ranks none.
[[nodiscard]] std::vector<PairBonds> bonds_of_run(const Simulation& simulation);

/// Points without strength of the pairs in contact that have any (lost_strength.hpp), on rank 0; on other ranks none.
[[nodiscard]] std::map<PairKey, std::vector<char>> points_without_strength_of_run(
    const Simulation& simulation);

/// Resources that a process has used so far.
struct ProcessUse {
  double processor = 0.0;         ///< s, of all threads
  std::uint64_t peak_memory = 0;  ///< bytes
};

/// Work and memory of one rank.
struct RankWork {
  int own = 0;               ///< blocks
  int ghosts = 0;            ///< blocks
  int ghost_searches = 0;    ///< after the first one
  int repartitions = 0;      ///< the same on all ranks
  double weight = 0.0;       ///< of own blocks (shared/rank_balance.hpp)
  int pairs = 0;             ///< in contact, that this rank makes
  int border_pairs = 0;      ///< in contact, with a block of another rank, that this one makes or receives
  int unknowns = 0;          ///< of own blocks
  std::uint64_t points = 0;  ///< contact points that this rank has made, sum over all steps
  int broken_pairs = 0;      ///< of all those that it has made: with failed area
  double broken_area = 0.0;  ///< m^2
  double bonded_area = 0.0;  ///< m^2, of all joints with strength
  PhaseSeconds seconds;
  RankTraffic traffic;
  RankTraffic for_results;  ///< part of it: results and checkpoints
  SharedWork shared;
  ProcessUse use;
};
/// By rank; the same on each. @param use of this process
[[nodiscard]] std::vector<RankWork> work_of_ranks(const Simulation& simulation, const ProcessUse& use = {});

}  // namespace ashlar

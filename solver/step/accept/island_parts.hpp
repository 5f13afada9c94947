// Islands of a whole run as one process sees them: what is summed or decided over the blocks of an island is put together
// over the processes. Islands are named by their lowest blocks (shared_island.hpp).
#pragma once

#include <optional>
#include <vector>

#include "geometry/index.hpp"
#include "solver/contact/contact_accounts.hpp"
#include "solver/step/accept/angular_momentum.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// The part of this process in an island; without other processes all of it.
struct IslandPart {
  int first = -1;                 ///< lowest block of the island
  bool joined = false;            ///< part of the island that processes share
  std::vector<int> bodies;        ///< own blocks, increasing
  std::vector<PairKey> contacts;  ///< own pairs, ties left out
  /// True if only its own blocks, gravity and loads act on the island, as far as this process knows
  bool free = true;
  double depth = 0.0;  ///< largest of contacts with multipliers as detected, m
};

/// Parts of all islands of a posed problem.
class PartsOfRun {
 public:
  /// Collective. @param islands must outlive this. @param shared index of the joined island; -1: none
  PartsOfRun(const BlockSystem& system, const std::vector<Island>& islands, int shared,
             const std::vector<ContactPair>& pairs);
  /// Index of the part of an own block that moves.
  [[nodiscard]] std::size_t part_of(int block) const { return static_cast<std::size_t>(part_of_[at(block)]); }
  /// Indices of the parts of an island.
  [[nodiscard]] std::vector<std::size_t> of_island(const Island& island) const;

  std::vector<IslandPart> parts;  ///< as many on all processes, in the order of first blocks

 private:
  const Island* joined_;      ///< null: none
  std::vector<int> part_of_;  ///< by block; -1: none
};

[[nodiscard]] SumOverProcesses summed_over_processes(const BlockSystem& system);

/// Accounts of the pairs of this process, for IslandFunds; empty without other processes.
[[nodiscard]] std::optional<SharedAccounts> shared_accounts(const BlockSystem& system);

}  // namespace ashlar

// Sums and extremes of a run that several ranks share, and results of other ranks that the first one needs.
#pragma once

#include <map>
#include <vector>

#include "solver/state/run_state.hpp"
#include "solver/statics/static_analysis.hpp"

namespace ashlar {

/// Contact points by state, as results show them.
struct ShownContacts {
  int open = 0;
  int locked = 0;
  int sliding = 0;
};

struct RunTotals {
  Ledger ledger;
  StepReport report;  ///< of the last step
  ContactExtremes extremes;
  Vector3 momentum = Vector3::Zero();          ///< kg m/s
  Vector3 angular_momentum = Vector3::Zero();  ///< kg m^2/s, about the origin
  SimulationCounts counts;
  int unknowns = 0;
  ShownContacts shown;
};

/// Results beyond totals, the same request on all ranks.
struct ResultNeeds {
  bool all = true;                  ///< states of all blocks, contacts and bonds of all pairs
  std::vector<int> blocks = {};     ///< otherwise: states of these, increasing
  std::vector<PairKey> pairs = {};  ///< and contacts of these, increasing
};

/// Results of all ranks, on the first one.
struct ToldResults {
  RunTotals totals;
  std::vector<PairRecord> contacts;  ///< by blocks
  std::vector<MovingBlock> moving;   ///< Simulation::moving_blocks(), by block
  /// Simulation::points_without_strength() of pairs that have such points
  std::map<PairKey, std::vector<char>> without_strength;
};

}  // namespace ashlar

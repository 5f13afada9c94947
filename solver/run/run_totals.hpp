// Sums and extremes of a run that several ranks share.
#pragma once

#include <vector>

#include "solver/state/run_state.hpp"
#include "solver/statics/static_analysis.hpp"

namespace ashlar {

struct RunTotals {
  Ledger ledger;
  StepReport report;  ///< of the last step
  ContactExtremes extremes;
  Vector3 momentum = Vector3::Zero();          ///< kg m/s
  Vector3 angular_momentum = Vector3::Zero();  ///< kg m^2/s, about the origin
  SimulationCounts counts;
  int unknowns = 0;
};

/// Results of all ranks, on the first one.
struct ToldResults {
  RunTotals totals;
  std::vector<PairRecord> contacts;  ///< by blocks
  std::vector<MovingBlock> moving;   ///< Simulation::moving_blocks(), by block
};

}  // namespace ashlar

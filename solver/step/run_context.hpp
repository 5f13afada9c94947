// The parts of a simulation that its step drivers modify. Other functions take only what they use.
#pragma once

#include <optional>

#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"
#include "solver/step/step_caches.hpp"

namespace ashlar {

/// All refer to one simulation, for the duration of one call.
struct RunContext {
  BlockSystem& system;
  RunState& state;
  StepCaches& caches;
  std::optional<StateFault>&
      fault;  ///< fault at the end of the last rejected step, if it was rejected for one

  [[nodiscard]] const SimulationSettings& settings() const { return system.settings(); }
};

}  // namespace ashlar

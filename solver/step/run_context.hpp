// The parts of a simulation that its steps modify.
#pragma once

#include <optional>

#include "solver/contact/depth_audit.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"
#include "solver/step/factor_cache.hpp"
#include "solver/step/step_contacts.hpp"

namespace ashlar {

/// All refer to one simulation and must outlive this.
struct RunContext {
  BlockSystem& system;
  RunState& state;
  StepContacts& contacts;
  FactorCache& factors;
  DepthAudit& audit;
  std::optional<StateFault>&
      fault;  ///< fault at the end of the last rejected step, if it was rejected for one

  [[nodiscard]] const std::vector<BlockModel>& blocks() const { return system.blocks(); }
  [[nodiscard]] const SimulationSettings& settings() const { return system.settings(); }
};

}  // namespace ashlar

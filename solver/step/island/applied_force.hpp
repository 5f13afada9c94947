// Forces whose work the ledger books as applied.
#pragma once

#include "mechanics/block/block_model.hpp"
#include "solver/settings.hpp"

namespace ashlar {

/// Loads, and gravity where it has a history: a force that changes with time has no potential. @param time s
/// @return (p, 3), N m^-3/2
[[nodiscard]] inline Eigen::MatrixX3d applied_force(const BlockModel& block,
                                                    const SimulationSettings& settings, double time) {
  return settings.gravity_history.empty() ? block.load_force(time)
                                          : block.external_force(settings.gravity_at(time), time);
}

}  // namespace ashlar

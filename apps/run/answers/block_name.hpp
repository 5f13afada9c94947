// Names of blocks in answers.
#pragma once

#include <string>

#include "geometry/index.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// @param block index into simulation.blocks()
[[nodiscard]] inline const std::string& block_name(const Simulation& simulation, int block) {
  return simulation.blocks()[at(block)].name();
}

}  // namespace ashlar
